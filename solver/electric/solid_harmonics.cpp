#include "electric/solid_harmonics.hpp"
#include <cmath>

namespace capsule {
namespace {

constexpr Eigen::Index terms = 16;
constexpr double tolerance = 1e-14;

// (1 - 2 u t + t^2)^(-power) = sum C_l(u) t^l: the polynomials of Legendre with a power of 1/2, those of Gegenbauer with 3/2.
Vector polynomials(double power, double u) {
  Vector c(terms);
  c[0] = 1;
  c[1] = 2 * power * u;
  for (Eigen::Index l = 2; l < terms; ++l) {
    const auto k = static_cast<double>(l);
    c[l] = (2 * u * (k + power - 1) * c[l - 1] - (k + 2 * power - 2) * c[l - 2]) / k;
  }
  return c;
}

} // namespace

// A harmonic function is known from its values on the axis, sum a_l z^l. A ring at distance R in the direction u makes
//   1/2 |e|^-1 = 1/2 sum P_l z^l/R^(l+1)   and   1/2 e.n |e|^-3,   e = (x - z, r).
SolidHarmonics::SolidHarmonics(const RingKernel &kernel, const Curve &curve, double centre)
    : centre_(centre), amplitudes_(Vector::Zero(terms)) {
  const Eigen::ArrayXd x = curve.x.array() - centre,
                       distance = (x.square() + curve.r.array().square()).sqrt();
  reach_ = distance.minCoeff() * std::pow(tolerance, 1.0 / static_cast<double>(terms));
  for (Eigen::Index k = 0; k < curve.size(); ++k) {
    const double u = x[k] / distance[k], t = reach_ / distance[k];
    const bool dipole = &kernel == &ring_dipole;
    const Vector c = polynomials(dipole ? 1.5 : 0.5, u);
    const double along_normal = x[k] * curve.normal_x[k] + curve.r[k] * curve.normal_r[k];
    double power = curve.area[k] / (2 * distance[k]); // times t^l
    for (Eigen::Index l = 0; l < terms; ++l, power *= t) {
      const double before = l > 0 ? curve.normal_x[k] * distance[k] * c[l - 1] : 0;
      amplitudes_[l] +=
          power * (dipole ? (along_normal * c[l] - before) / (distance[k] * distance[k]) : c[l]);
    }
  }
}

bool SolidHarmonics::hold(const Targets &points) const {
  return ((points.x.array() - centre_).square() + points.r.array().square() < reach_ * reach_).all();
}

// (l + 1) H_(l+1) = (2 l + 1) x H_l - l rho^2 H_(l-1)
Vector SolidHarmonics::at(const Targets &points) const {
  const Eigen::ArrayXd x = (points.x.array() - centre_) / reach_;
  const Eigen::ArrayXd rho2 = x.square() + (points.r.array() / reach_).square();
  Eigen::ArrayXd before = Eigen::ArrayXd::Zero(x.size()), here = Eigen::ArrayXd::Ones(x.size());
  Eigen::ArrayXd sum = Eigen::ArrayXd::Constant(x.size(), amplitudes_[0]);
  for (Eigen::Index l = 1; l < terms; ++l) {
    const auto k = static_cast<double>(l);
    const Eigen::ArrayXd next = ((2 * k - 1) / k) * x * here - ((k - 1) / k) * rho2 * before;
    before = here;
    here = next;
    sum += amplitudes_[l] * here;
  }
  return sum;
}

} // namespace capsule
