#pragma once
// What the player of the page shows of a run.
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

namespace report {

// The runs that have more than 20 profiles, for player.js, whose head says what is in it. Throws FileError and InputError
// for results that cannot be read.
nlohmann::ordered_json player_data(const std::vector<std::filesystem::path> &runs);

} // namespace report
