#pragma once
// Bounds of a march's errors from its differences to a slightly coarser one (motion; what was weighed:
// paper-notes/methods.md). Throws nothing.
#include "case/parameters.hpp"
#include "observe/outcome.hpp"
#include <map>
#include <string>
#include <vector>

namespace capsule {

struct Case;

// Of what summary.json reports, by name: the largest difference times a margin over all rows at the same x_g, "v_g@x_g",
// or at the same time, "v_g@time", and over the last part of the way, "v_g"; a single row may agree by accident. Of the
// largest values over the way, "largest_tension", the difference half a radius around. Neither series may be empty. Without
// rows at the same x_g or time nothing tells the errors: there are no estimates.
std::map<std::string, double> estimate_errors(const std::vector<SeriesRow> &fine,
                                              const std::vector<SeriesRow> &coarse, bool by_x_g,
                                              Scheme scheme);

// Of the capsules behind the leading one, of rows at the same x_g of the leading one or the same time: "v_g#2@x_g", "v_g#2"
// and so on of the second.
void add_errors_of_followers(const Checkpoint &fine, const Checkpoint &coarse, bool by_x_g, Scheme scheme,
                             std::map<std::string, double> &errors);

// Of the transit's numbers, "transit_time" ..., which both marches have; of the pulse's height only where rows of both are at
// the same x_g.
void add_errors_of_transit(const Case &physics, const std::vector<SeriesRow> &fine,
                           const std::vector<SeriesRow> &coarse, std::map<std::string, double> &errors);

// Where both marches end by themselves, or where the last of several capsules arrives: "time" and "x_g" of the last rows,
// and "x_g#2" and so on.
void add_errors_of_the_end(const Checkpoint &fine, const Checkpoint &coarse, Scheme scheme,
                           std::map<std::string, double> &errors);

} // namespace capsule
