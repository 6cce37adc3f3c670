#include "output/paraview.hpp"
#include "base/text.hpp"
#include "observe/quantities.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <string_view>

namespace capsule {
namespace {

// Which points of a profile a picture needs: at most 128 steps along the meridian, from pole to pole.
std::vector<Eigen::Index> pictured_points(const Profile &profile) {
  const Eigen::Index last = profile.x.size() - 1, stride = 1 + last / 128;
  std::vector<Eigen::Index> chosen;
  for (Eigen::Index i = 0; i < last; i += stride)
    chosen.push_back(i);
  chosen.push_back(last);
  return chosen;
}

constexpr int turns = 32;

// A meridian turned about the axis, with fields of the whole and at its points.
std::string revolved(const Vector &x, const Vector &r, const std::string &of_all,
                     const std::string &at_points) {
  const Eigen::Index points = x.size();
  std::string positions, connectivity, offsets;
  for (Eigen::Index i = 0; i < points; ++i)
    for (int k = 0; k < turns; ++k) {
      const double azimuth = 2 * std::numbers::pi * k / turns;
      positions +=
          fmt::format("{:.6g} {:.6g} {:.6g}\n", x[i], r[i] * std::cos(azimuth), r[i] * std::sin(azimuth));
    }
  const auto point = [](Eigen::Index i, int k) { return i * turns + k % turns; };
  for (Eigen::Index i = 0; i + 1 < points; ++i) {
    for (int k = 0; k <= turns; ++k)
      connectivity += fmt::format("{} {}\n", point(i, k), point(i + 1, k));
    offsets += fmt::format("{}\n", (i + 1) * 2 * (turns + 1));
  }
  return fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\">\n<PolyData>\n{}"
                     "<Piece NumberOfPoints=\"{}\" NumberOfStrips=\"{}\">\n{}"
                     "<Points>\n<DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">\n{}"
                     "</DataArray>\n</Points>\n<Strips>\n"
                     "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">\n{}</DataArray>\n"
                     "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">\n{}</DataArray>\n"
                     "</Strips>\n</Piece>\n</PolyData>\n</VTKFile>\n",
                     of_all, points * turns, points - 1, at_points, positions, connectivity, offsets);
}

} // namespace

std::string surface_name(std::size_t index, std::size_t capsule) {
  return fmt::format("membrane{}_{:04}.vtp", capsule == 0 ? "" : fmt::format("-{}", capsule + 1), index);
}

// A strip of triangles between each two points.
std::string surface_vtp(const Profile &profile, const std::string &along) {
  const std::vector<Eigen::Index> chosen = pictured_points(profile);
  std::string fields;
  for (const ProfileQuantity &quantity : profile_quantities()) {
    const std::string_view name = quantity.name;
    if (!name.starts_with("stretch") && !name.starts_with("tension"))
      continue;
    fields += fmt::format("<DataArray type=\"Float32\" Name=\"{}\" format=\"ascii\">\n", name);
    for (const Eigen::Index i : chosen)
      for (int k = 0; k < turns; ++k)
        fields += fmt::format("{:.5g}\n", (profile.*quantity.values)[i]);
    fields += "</DataArray>\n";
  }
  const std::string of_all = along.empty()
                                 ? ""
                                 : fmt::format("<FieldData>\n<DataArray type=\"Float64\" Name=\"{}\" "
                                               "NumberOfTuples=\"1\" format=\"ascii\">\n{}\n"
                                               "</DataArray>\n</FieldData>\n",
                                               along, number_text(profile.time));
  return revolved(profile.x(chosen), profile.r(chosen), of_all,
                  fmt::format("<PointData>\n{}</PointData>\n", fields));
}

std::string wall_vtp(const Pore &pore) {
  constexpr int points = 200;
  constexpr double outside = 10;
  const bool tube = pore.shape == PoreShape::tube;
  const double first = std::max(pore.exit_arc, -outside);
  const double last = tube ? pore.entrance_arc : std::min(pore.entrance_arc, pore.exit_x + outside);
  Vector x(points), r(points);
  for (Eigen::Index i = 0; i < points; ++i) {
    const WallPoint point = wall_point(pore, first + (last - first) * static_cast<double>(i) / (points - 1));
    x[i] = point.x;
    r[i] = point.r;
  }
  return revolved(x, r, "", "");
}

std::string surfaces_pvd(const std::vector<Profile> &profiles, const std::string &along,
                         std::size_t capsules) {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (std::size_t i = 0; i < profiles.size(); ++i)
    for (std::size_t k = 0; k < capsules; ++k)
      text += fmt::format("<DataSet timestep=\"{}\"{} file=\"{}\"/>\n",
                          along.empty() ? number_text(profiles[i].time) : std::to_string(i),
                          capsules == 1 ? "" : fmt::format(" part=\"{}\"", k), surface_name(i, k));
  return text + "</Collection>\n</VTKFile>\n";
}

} // namespace capsule
