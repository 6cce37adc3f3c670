#include "observe/quantities.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

namespace capsule {
namespace {

constexpr PhysicalUnit second{&Scales::time, dimension::time};
constexpr PhysicalUnit metre{&Scales::length, dimension::length};
constexpr PhysicalUnit metre_per_second{&Scales::velocity, dimension::velocity};
constexpr PhysicalUnit pascal{&Scales::pressure, dimension::pressure};
constexpr PhysicalUnit ohm{&Scales::resistance, dimension::resistance};
constexpr PhysicalUnit newton_per_metre{&Scales::tension, dimension::tension};

// What all of the membrane makes converges faster with the mesh than the stretches, which are local.
constexpr Agreement tenth{.share = 0.1}, tenth_of_value{.share = 0.1, .relative = true};
constexpr Agreement whole_of_value{.share = 1, .relative = true};

constexpr std::array quantities{
    ReportedQuantity{
        .name = "time",
        .meaning =
            "since the capsule was released, undeformed, at `capsule.start_x`; for a branch the value of the "
            "key that varies",
        .value = &SeriesRow::time,
        .unit = second,
        .error = ErrorEstimate::of_marches},
    ReportedQuantity{.name = "x_g",
                     .meaning = "centre of mass on the axis; the mouth of the tube is at 0",
                     .value = &SeriesRow::x_g,
                     .unit = metre,
                     .error = ErrorEstimate::of_marches},
    ReportedQuantity{.name = "v_g",
                     .meaning = "velocity of the centre of mass",
                     .value = &SeriesRow::v_g,
                     .unit = metre_per_second,
                     .error = ErrorEstimate::of_all,
                     .agreement = tenth,
                     .branch_column = 1},
    ReportedQuantity{
        .name = "pressure_drop",
        .meaning = "extra pressure drop that the capsule causes, by the exit section's unknown of eq. 16",
        .value = &SeriesRow::pressure_drop,
        .unit = pascal,
        .error = ErrorEstimate::of_all,
        .agreement = tenth_of_value,
        .of_the_pore = true,
        .branch_column = 2},
    ReportedQuantity{.name = "max_stretch",
                     .meaning = "largest meridional stretch ratio, lambda_s",
                     .value = &SeriesRow::max_stretch,
                     .error = ErrorEstimate::of_all,
                     .agreement = whole_of_value,
                     .branch_column = 3},
    ReportedQuantity{.name = "min_film",
                     .meaning = "smallest distance between membrane and wall; null without a wall",
                     .value = &SeriesRow::min_film,
                     .unit = metre,
                     .error = ErrorEstimate::of_all,
                     .of_the_pore = true,
                     .branch_column = 4},
    ReportedQuantity{.name = "volume_change",
                     .meaning = "change of the volume relative to the start: zero except for errors",
                     .value = &SeriesRow::volume_change,
                     .error = ErrorEstimate::by_value_itself,
                     .branch_column = 8},
    ReportedQuantity{
        .name = "pressure_drop_reciprocal",
        .meaning = "the pressure drop by the reciprocal theorem, which assumes undisturbed flow at the "
                   "exit: far from the exit the two differ by the error of the quadrature, near it by the "
                   "influence of the exit on the flow",
        .value = &SeriesRow::pressure_drop_reciprocal,
        .of_the_pore = true},
    ReportedQuantity{
        .name = "flow_rate",
        .meaning =
            "Q over that without a capsule: 1, or less where `flow.drive = \"pressure\"` keeps the pressure",
        .value = &SeriesRow::flow_rate,
        .unit = PhysicalUnit{&Scales::flow_rate, dimension::flow_rate},
        .error = ErrorEstimate::of_all,
        .of_the_pore = true,
        .branch_column = 11},
    ReportedQuantity{.name = "max_area_stretch",
                     .meaning = "largest area stretch, lambda_s lambda_phi",
                     .value = &SeriesRow::max_area_stretch,
                     .error = ErrorEstimate::of_all,
                     .branch_column = 12},
    ReportedQuantity{.name = "S_at_max_area_stretch",
                     .meaning = "where on the membrane, as arc length S of profiles",
                     .value = &SeriesRow::S_at_max_area_stretch,
                     .unit = metre},
    ReportedQuantity{.name = "max_tension",
                     .meaning = "largest principal tension",
                     .value = &SeriesRow::max_tension,
                     .unit = newton_per_metre,
                     .error = ErrorEstimate::of_all,
                     .branch_column = 13},
    ReportedQuantity{.name = "S_at_max_tension",
                     .meaning = "where on the membrane, as arc length S of profiles",
                     .value = &SeriesRow::S_at_max_tension,
                     .unit = metre},
    ReportedQuantity{.name = "front_stretch",
                     .meaning = "meridional stretch ratio at the downstream pole",
                     .value = &SeriesRow::front_stretch,
                     .error = ErrorEstimate::of_all,
                     .agreement = whole_of_value,
                     .branch_column = 5},
    ReportedQuantity{.name = "length",
                     .meaning = "axial extent",
                     .value = &SeriesRow::length,
                     .unit = metre,
                     .error = ErrorEstimate::of_all,
                     .agreement = tenth_of_value,
                     .branch_column = 6},
    ReportedQuantity{.name = "deformation",
                     .meaning = "(length - diameter)/(length + diameter)",
                     .value = &SeriesRow::deformation,
                     .error = ErrorEstimate::of_all,
                     .agreement = tenth,
                     .branch_column = 7},
    ReportedQuantity{.name = "area_change",
                     .meaning = "change of the membrane's area relative to the start",
                     .value = &SeriesRow::area_change,
                     .branch_column = 9},
    ReportedQuantity{
        .name = "max_axial_residual",
        .meaning = "largest difference of the membrane's axial velocity from `v_g`: zero in a steady state",
        .value = &SeriesRow::max_axial_residual,
        .error = ErrorEstimate::of_marches},
    ReportedQuantity{.name = "max_radial_velocity",
                     .meaning = "largest radial velocity of the membrane: zero in a steady state",
                     .value = &SeriesRow::max_radial_velocity,
                     .error = ErrorEstimate::of_marches},
    ReportedQuantity{
        .name = "dents",
        .meaning = "concave stretches in which the meridian turns back by more than 0.15 rad: a parachute "
                   "has one, three or more are wrinkles",
        .value = &SeriesRow::dents,
        .branch_column = 10},
    ReportedQuantity{
        .name = "roughness",
        .meaning = "share of the bending that lies in the mesh's shortest third of waves: large where the "
                   "mesh cannot resolve the shape",
        .value = &SeriesRow::roughness},
    ReportedQuantity{
        .name = "resistance",
        .meaning =
            "with `output.resistance`: electric resistance that the capsule adds to the pore, in rho/(pi "
            "R_t), that of a pore radius of empty tube; the liquid conducts, wall and membrane insulate",
        .value = &SeriesRow::resistance,
        .unit = ohm,
        .error = ErrorEstimate::of_all,
        .agreement = tenth_of_value,
        .of_the_pore = true,
        .branch_column = 14,
        .if_asked = true},
    ReportedQuantity{.name = "resistance_long_conductor",
                     .meaning =
                         "the same by the paper's estimate, slices of a long conductor in series, with "
                         "the outermost radius where a concave end gives several",
                     .value = &SeriesRow::resistance_long_conductor,
                     .unit = ohm,
                     .error = ErrorEstimate::of_all,
                     .agreement = tenth_of_value,
                     .of_the_pore = true,
                     .branch_column = 15,
                     .if_asked = true},
    ReportedQuantity{.name = "pressure_share",
                     .meaning =
                         "of several capsules: the part of the pressure drop that is this one's, by the "
                         "reciprocal theorem; the parts add up to `pressure_drop_reciprocal`",
                     .value = &SeriesRow::pressure_share,
                     .unit = pascal,
                     .error = ErrorEstimate::of_marches,
                     .of_the_pore = true,
                     .if_asked = true},
    ReportedQuantity{.name = "spacing",
                     .meaning = "of a capsule behind another: the distance of their centres",
                     .value = &SeriesRow::spacing,
                     .unit = metre,
                     .error = ErrorEstimate::of_marches,
                     .of_the_pore = true,
                     .if_asked = true},
    ReportedQuantity{.name = "min_gap",
                     .meaning =
                         "of a capsule behind another, and of a steady train: the smallest distance of "
                         "neighbouring membranes",
                     .value = &SeriesRow::min_gap,
                     .unit = metre,
                     .error = ErrorEstimate::of_all,
                     .of_the_pore = true,
                     .branch_column = 16,
                     .if_asked = true},
};
static_assert(quantities.size() * sizeof(double) == sizeof(SeriesRow), "a line for each member of SeriesRow");

constexpr std::array of_the_peak{
    PeakQuantity{"peak_pressure_drop", &Peak::pressure_drop, pascal},
    PeakQuantity{"x_g_at_peak", &Peak::x_g, metre},
};

constexpr std::array of_the_way{
    LargestQuantity{"area_stretch", &SeriesRow::max_area_stretch, &SeriesRow::S_at_max_area_stretch},
    LargestQuantity{"tension", &SeriesRow::max_tension, &SeriesRow::S_at_max_tension},
};

constexpr std::array of_a_profile{
    ProfileQuantity{"S", &Profile::S, metre},
    ProfileQuantity{"x", &Profile::x, metre},
    ProfileQuantity{"r", &Profile::r, metre},
    ProfileQuantity{"stretch_meridional", &Profile::stretch_meridional},
    ProfileQuantity{"stretch_azimuthal", &Profile::stretch_azimuthal},
    ProfileQuantity{"tension_meridional", &Profile::tension_meridional, newton_per_metre},
    ProfileQuantity{"tension_azimuthal", &Profile::tension_azimuthal, newton_per_metre},
    ProfileQuantity{"moment_meridional", &Profile::moment_meridional},
    ProfileQuantity{"moment_azimuthal", &Profile::moment_azimuthal},
    ProfileQuantity{"curvature_meridional", &Profile::curvature_meridional},
    ProfileQuantity{"curvature_azimuthal", &Profile::curvature_azimuthal},
    ProfileQuantity{"velocity_x", &Profile::velocity_x, metre_per_second},
    ProfileQuantity{"velocity_r", &Profile::velocity_r, metre_per_second},
};

} // namespace

std::string name_with_unit(const std::string &name, const PhysicalUnit &unit) {
  return fmt::format("{} [{}]", name, unit_text(unit.dimension));
}

bool has_scale(const std::optional<PhysicalUnit> &unit, const Scales &scales) {
  return unit && scales.*unit->scale > 0;
}

bool is_reported(const ReportedQuantity &quantity, const SeriesRow &row) {
  return !quantity.if_asked || !std::isnan(row.*quantity.value);
}

std::span<const ReportedQuantity> reported_quantities() {
  return quantities;
}

std::vector<ReportedQuantity> branch_quantities() {
  std::vector<ReportedQuantity> chosen;
  std::ranges::copy_if(quantities, std::back_inserter(chosen),
                       [](const ReportedQuantity &quantity) { return quantity.branch_column > 0; });
  std::ranges::sort(chosen, {}, &ReportedQuantity::branch_column);
  return chosen;
}

std::span<const PeakQuantity> peak_quantities() {
  return of_the_peak;
}

std::span<const LargestQuantity> largest_quantities() {
  return of_the_way;
}

std::span<const ProfileQuantity> profile_quantities() {
  return of_a_profile;
}

} // namespace capsule
