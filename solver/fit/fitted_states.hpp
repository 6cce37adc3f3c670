#pragma once
// Steady states of one capsule beside the contours that were measured of it: residuals and their slopes for a fit.
//   parameters   the unknown keys, for each further contour its own capillary number if the flow rates are not known, each
//                contour's place on the axis, and where several velocities stand in for flow rates ln(mu/G)
//   residuals    orthogonal distances of the points over their standard deviation; of a rear pole the same; of each
//                velocity its relative deviation over its standard deviation
// A state at other parameters is found by Newton's method from u + (du/dp) dp with the sensitivities of slopes.hpp.
// Throws NumericsFailure where there is no steady state near by.
#include "fit/contour.hpp"
#include "fit/least_squares.hpp"
#include "fit/outline.hpp"
#include "steady/mesh_change.hpp"
#include <span>
#include <vector>

namespace capsule {

class FittedStates {
public:
  // `input` has values for all other keys, and its physical ones. With the contours in the order of the flow rates, if these
  // are known.
  FittedStates(Case input, std::vector<std::string> keys, std::span<const Contour> contours);

  // Where the search begins: one state for all contours, at the values of the keys that its system has.
  Vector begin_with(const SteadyState &state);
  Residuals evaluate(const Vector &parameters);
  // Other meshes for the states, as fine as this and suited to their shapes. Throws NumericsFailure and Interrupted.
  void change_mesh(int nodes, const Control &control);
  double unresolved() const; // error of the positions, node_density.hpp: the largest of all states
  int nodes() const { return static_cast<int>(anchors_.front().state.system->nodes()); }

  // The last states that were found, from which others are.
  struct Anchor {
    SteadyState state;
    Vector values;        // of the keys
    Matrix sensitivities; // to them
    DenseMeridian dense;
  };
  const std::vector<Anchor> &anchors() const { return anchors_; }
  void return_to(const std::vector<Anchor> &anchors);
  // From now on also from these, where Newton's method fails from the last ones.
  void keep_anchors() { kept_ = anchors_; }

  Eigen::Index points() const; // rows of residuals that are distances
  bool has_velocities() const { return velocity_rows_ > 0; }
  void set_noise(double noise) { noise_ = noise; }
  double noise() const { return noise_; }
  const std::vector<std::string> &keys() const { return keys_; }
  std::span<const Contour> contours() const { return contours_; }
  const Case &input() const { return input_; }

  // Names of the parameters; those of places on the axis begin with "place".
  std::vector<std::string> names() const;
  Eigen::Index place(std::size_t contour) const { return places_ + static_cast<Eigen::Index>(contour); }
  // A key's value for a contour.
  double value(const Vector &parameters, std::size_t contour, std::size_t key) const;
  // ln G and its slopes, from the flow rate or, without one, from the velocity; nothing where neither is known.
  struct Modulus {
    double logarithm = 0;
    Vector slopes;
    bool of_velocity = false;
  };
  std::optional<Modulus> modulus(const Vector &parameters) const;
  std::optional<double> velocity(std::size_t contour) const; // as it was measured
  // Feet of a contour's points, in its own coordinate.
  std::vector<Foot> feet(const Vector &parameters, std::size_t contour) const;

private:
  Residuals evaluate_from(const std::vector<Anchor> &anchors, const Vector &parameters);
  Case case_with(const Vector &values) const; // of the keys
  Eigen::Index parameter(std::size_t contour, std::size_t key) const;
  double factor(std::size_t contour, std::size_t key) const;
  std::optional<double> flow_rate(std::size_t contour) const;
  double velocity_noise() const { return input_.fit.velocity_noise.value_or(0.01); }

  Case input_;
  std::vector<std::string> keys_;
  std::vector<Contour> contours_;
  std::vector<Anchor> anchors_, kept_;
  double noise_ = 0.005;
  std::size_t flow_key_;        // index of the capillary number among the keys; their number if it is known
  bool flows_known_;            // so that capillary numbers are in their ratio
  Eigen::Index places_, scale_; // where these parameters begin; scale_ -1: none
  Eigen::Index size_, velocity_rows_;
};

} // namespace capsule
