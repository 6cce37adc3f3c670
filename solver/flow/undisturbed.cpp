#include "flow/undisturbed.hpp"

namespace capsule {

double poiseuille_velocity(double r) {
  return 2 * (1 - r * r);
}

double poiseuille_shear(double r) {
  return -4 * r;
}

double poiseuille_pressure_drop(double length) {
  return 8 * length;
}

Vector liquid_at_rest(const Targets &points) {
  return Vector::Zero(2 * points.size());
}

Vector poiseuille_flow(const Targets &points) {
  Vector velocity = liquid_at_rest(points);
  velocity.head(points.size()) = points.r.unaryExpr(&poiseuille_velocity);
  return velocity;
}

Vector extensional_flow(const Targets &points) {
  Vector velocity(2 * points.size());
  velocity << points.x, -0.5 * points.r;
  return velocity;
}

} // namespace capsule
