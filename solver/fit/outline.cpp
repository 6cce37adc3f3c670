#include "fit/outline.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace capsule {

DenseMeridian dense_meridian(const MeridianBasis &basis) {
  const Eigen::Index points = 8 * basis.size() + 1;
  const Vector zeta = Vector::LinSpaced(points, 0, std::numbers::pi);
  DenseMeridian dense;
  dense.step = zeta[1];
  for (int derivative = 0; derivative < 2; ++derivative) {
    dense.even[derivative] = basis.even(zeta, derivative);
    dense.odd[derivative] = basis.odd(zeta, derivative);
  }
  return dense;
}

Outline::Outline(const DenseMeridian &dense, const Vector &position, OutlineSeen seen) {
  const Eigen::Index n = position.size() / 2;
  x_ = dense.even[0] * position.head(n);
  r_ = dense.odd[0] * position.tail(n);
  x_slope_ = dense.step * (dense.even[1] * position.head(n));
  r_slope_ = dense.step * (dense.odd[1] * position.tail(n));
  Eigen::Index rearmost = 0;
  x_.minCoeff(&rearmost);
  if (seen == OutlineSeen::silhouette && rearmost > 0) {
    rim_ = static_cast<double>(rearmost);
    for (int k = 0; k < 3; ++k) {
      const Point here = at(rim_);
      rim_ = std::clamp(rim_ - here.x_slope / here.x_second, static_cast<double>(rearmost) - 1,
                        static_cast<double>(rearmost) + 1);
    }
  }
  rim_point_ = at(rim_);
}

// Hermite's cubic between two points.
Outline::Point Outline::at(double index) const {
  const auto k = std::clamp<Eigen::Index>(static_cast<Eigen::Index>(index), 0, x_.size() - 2);
  const double t = index - static_cast<double>(k);
  const auto cubic = [&](const Vector &f, const Vector &slope, double &value, double &first, double &second) {
    const double a = f[k], b = slope[k], rise = f[k + 1] - f[k];
    const double c = 3 * rise - 2 * slope[k] - slope[k + 1], d = slope[k] + slope[k + 1] - 2 * rise;
    value = a + t * (b + t * (c + t * d));
    first = b + t * (2 * c + t * 3 * d);
    second = 2 * c + t * 6 * d;
  };
  Point point{};
  cubic(x_, x_slope_, point.x, point.x_slope, point.x_second);
  cubic(r_, r_slope_, point.r, point.r_slope, point.r_second);
  return point;
}

Foot Outline::foot(double x, double r) const {
  const double last = static_cast<double>(x_.size() - 1);
  const auto first = static_cast<Eigen::Index>(std::ceil(rim_));
  Eigen::Index nearest = first;
  ((x_.array() - x).square() + (r_.array() - r).square()).tail(x_.size() - first).minCoeff(&nearest);
  double index = static_cast<double>(first + nearest);
  Point point = at(index);
  for (int k = 0; k < 6; ++k) {
    const double along = (x - point.x) * point.x_slope + (r - point.r) * point.r_slope;
    const double bend = point.x_slope * point.x_slope + point.r_slope * point.r_slope -
                        (x - point.x) * point.x_second - (r - point.r) * point.r_second;
    const double change = std::clamp(along / bend, -1.0, 1.0);
    index = std::clamp(bend > 0 ? index + change : index, rim_, last);
    point = at(index);
    if (std::abs(change) < 1e-10)
      break;
  }
  const double speed = std::hypot(point.x_slope, point.r_slope);
  Foot foot{.normal_x = -point.r_slope / speed,
            .normal_r = point.x_slope / speed,
            .x = point.x,
            .r = point.r,
            .at = index};
  foot.distance = foot.normal_x * (x - point.x) + foot.normal_r * (r - point.r);
  const double plane = rim_point_.x - x; // distance to the rim's plane
  const double gap = std::hypot(x - point.x, r - point.r);
  if (rim_ > 0 && r < rim_point_.r && std::abs(plane) < gap)
    return {.distance = plane, .normal_x = -1, .normal_r = 0, .x = rim_point_.x, .r = r, .at = rim_};
  return foot;
}

Eigen::Matrix<double, 2, Eigen::Dynamic> moved_at(const Matrix &even_values, const Matrix &odd_values,
                                                  double index) {
  const auto k = std::clamp<Eigen::Index>(static_cast<Eigen::Index>(index), 0, even_values.rows() - 2);
  const double t = index - static_cast<double>(k);
  Eigen::Matrix<double, 2, Eigen::Dynamic> moved(2, even_values.cols());
  moved.row(0) = (1 - t) * even_values.row(k) + t * even_values.row(k + 1);
  moved.row(1) = (1 - t) * odd_values.row(k) + t * odd_values.row(k + 1);
  return moved;
}

} // namespace capsule
