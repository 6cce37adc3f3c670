#pragma once
// The columns of a run's tables, each declared once: its name and where its values are.
#include "case/physical.hpp"
#include "observe/records.hpp"
#include <algorithm>
#include <array>
#include <string_view>

namespace capsule {

// Of series.csv, and the end of a run in summary.json.
struct SeriesColumn {
  const char *name;
  double SeriesRow::*value;
};
inline constexpr std::array series_columns{
    SeriesColumn{"time", &SeriesRow::time},
    SeriesColumn{"x_g", &SeriesRow::x_g},
    SeriesColumn{"v_g", &SeriesRow::v_g},
    SeriesColumn{"pressure_drop", &SeriesRow::pressure_drop},
    SeriesColumn{"max_stretch", &SeriesRow::max_stretch},
    SeriesColumn{"min_film", &SeriesRow::min_film},
    SeriesColumn{"volume_change", &SeriesRow::volume_change},
    SeriesColumn{"pressure_drop_reciprocal", &SeriesRow::pressure_drop_reciprocal},
    SeriesColumn{"front_stretch", &SeriesRow::front_stretch},
    SeriesColumn{"length", &SeriesRow::length},
    SeriesColumn{"deformation", &SeriesRow::deformation},
    SeriesColumn{"area_change", &SeriesRow::area_change},
    SeriesColumn{"max_axial_residual", &SeriesRow::max_axial_residual},
    SeriesColumn{"max_radial_velocity", &SeriesRow::max_radial_velocity},
    SeriesColumn{"dents", &SeriesRow::dents},
    SeriesColumn{"roughness", &SeriesRow::roughness},
};

// The one of this name; none is an error of compilation.
consteval SeriesColumn series_column(std::string_view name) {
  return *std::ranges::find(series_columns, name, &SeriesColumn::name);
}

// Of branch.csv, and of folds.
inline constexpr std::array branch_columns{
    series_column("v_g"),         series_column("pressure_drop"), series_column("max_stretch"),
    series_column("min_film"),    series_column("front_stretch"), series_column("length"),
    series_column("deformation"), series_column("volume_change"), series_column("area_change"),
    series_column("dents"),
};

// Of profiles.csv.
struct ProfileColumn {
  const char *name;
  Vector Profile::*values;
};
inline constexpr std::array profile_columns{
    ProfileColumn{"S", &Profile::S},
    ProfileColumn{"x", &Profile::x},
    ProfileColumn{"r", &Profile::r},
    ProfileColumn{"stretch_meridional", &Profile::stretch_meridional},
    ProfileColumn{"stretch_azimuthal", &Profile::stretch_azimuthal},
    ProfileColumn{"tension_meridional", &Profile::tension_meridional},
    ProfileColumn{"tension_azimuthal", &Profile::tension_azimuthal},
    ProfileColumn{"moment_meridional", &Profile::moment_meridional},
    ProfileColumn{"moment_azimuthal", &Profile::moment_azimuthal},
    ProfileColumn{"curvature_meridional", &Profile::curvature_meridional},
    ProfileColumn{"curvature_azimuthal", &Profile::curvature_azimuthal},
    ProfileColumn{"velocity_x", &Profile::velocity_x},
    ProfileColumn{"velocity_r", &Profile::velocity_r},
};

// What carries a unit, of a row and of a summary: series_physical.csv.
struct PhysicalColumn {
  const char *name;
  double Scales::*scale;
  Dimension of;
};
inline constexpr std::array physical_columns{
    PhysicalColumn{"time", &Scales::time, dimension::time},
    PhysicalColumn{"x_g", &Scales::length, dimension::length},
    PhysicalColumn{"v_g", &Scales::velocity, dimension::velocity},
    PhysicalColumn{"pressure_drop", &Scales::pressure, dimension::pressure},
    PhysicalColumn{"min_film", &Scales::length, dimension::length},
    PhysicalColumn{"length", &Scales::length, dimension::length},
    PhysicalColumn{"peak_pressure_drop", &Scales::pressure, dimension::pressure},
    PhysicalColumn{"x_g_at_peak", &Scales::length, dimension::length},
};

} // namespace capsule
