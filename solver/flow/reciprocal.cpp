#include "flow/reciprocal.hpp"
#include "flow/layer_identities.hpp"

namespace capsule {
namespace {

// sigma_e n from v_e on the membranes: v_e/2 = S t/(8 pi) + D v_e inside. In each membrane t is free up to a
// pressure; the one chosen makes int t.n dA vanish.
Vector base_traction(const Interaction &interaction, double tolerance, Recycled &recycled) {
  const Matrix normals = normals_of(interaction.mesh(), interaction.shape());
  const Matrix weighted = interaction.shape().nodes.area.replicate(2, 1).asDiagonal() * normals;
  const Vector &velocity = interaction.base_velocity();
  const Vector known = 0.5 * velocity - interaction.double_layer(velocity);
  const auto apply = [&](const Vector &traction) {
    return Vector(stokeslet_factor * interaction.single_layer(traction) +
                  normals * (weighted.transpose() * traction));
  };
  return solve_recycled(
      interaction.shape().position, tolerance, recycled,
      [&](const Vector &traction) { return Vector(known - apply(traction)); }, apply,
      [&]() -> Matrix {
        return stokeslet_factor * interaction.single_layer() + normals * weighted.transpose();
      });
}

} // namespace

Vector reciprocal_pressure_drops(const Interaction &interaction, const Vector &f,
                                 const Vector &excess_velocity, double tolerance, Recycled &traction) {
  const MembraneMesh &mesh = interaction.mesh();
  if (interaction.wall().unknowns() == 0)
    return Vector::Zero(std::ssize(mesh.parts));
  const Vector area2 = interaction.shape().nodes.area.replicate(2, 1);
  const Vector power = f.cwiseProduct(interaction.base_velocity());
  const Vector of_liquid =
      excess_velocity.size() > 0
          ? Vector(excess_velocity.cwiseProduct(base_traction(interaction, tolerance, traction)))
          : Vector();
  Vector drops(std::ssize(mesh.parts));
  for (std::size_t k = 0; k < mesh.parts.size(); ++k) {
    const std::vector<Eigen::Index> rows = mesh.rows(k);
    double sum = -Vector(area2(rows)).dot(Vector(power(rows)));
    if (of_liquid.size() > 0)
      sum += Vector(area2(rows)).dot(Vector(of_liquid(rows)));
    drops[static_cast<Eigen::Index>(k)] = 2 * sum; // an integral over the area is 2 pi times the sum
  }
  return drops;
}

} // namespace capsule
