#pragma once
// What a whole run costs, in seconds on one core, from runs that were measured on one server: good to a factor of three.
// Throws nothing.

namespace capsule {

struct Case;

double estimated_seconds(const Case &physics);
// Of a search for a steady state, by its work (Control::spend).
double seconds_of_search(double work);

} // namespace capsule
