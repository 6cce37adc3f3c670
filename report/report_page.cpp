// Writes the report: one HTML page that contains everything and loads nothing.
//   report_page PAGE DIRECTORY...
// writes PAGE. Each DIRECTORY is a case, cases/<id>, or a study, validation/<id>. Its figures, comparison and results are
// read from figures/<id>/, tables/<id>.csv and results/<id>/, where `make figures` and `make atlas` write them; what has
// not been computed yet is left out. The page's frame, style and player are beside this file.
#include "base/atomic_file.hpp"
#include "base/csv.hpp"
#include "base/text.hpp"
#include "case/case_file.hpp"
#include "law/law.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// The files of a directory with this ending, by name; none if there is no such directory.
std::vector<fs::path> files_of(const fs::path &directory, const std::string &ending) {
  std::vector<fs::path> files;
  if (fs::is_directory(directory))
    for (const fs::directory_entry &entry : fs::directory_iterator(directory))
      if (entry.path().extension() == ending)
        files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

std::string escaped(const std::string &text) {
  std::string html;
  for (const char c : text)
    html += c == '&'   ? "&amp;"
            : c == '<' ? "&lt;"
            : c == '>' ? "&gt;"
            : c == '"' ? "&quot;"
                       : std::string(1, c);
  return html;
}

// Makes an element of each part of a text that stands between two marks.
std::string marked(const std::string &text, const std::string &mark, const std::string &element) {
  std::string html;
  std::size_t from = 0;
  for (std::size_t open = 0; (open = text.find(mark, from)) != std::string::npos;) {
    const std::size_t close = text.find(mark, open + mark.size());
    if (close == std::string::npos)
      break;
    html += text.substr(from, open - from);
    html +=
        fmt::format("<{0}>{1}</{0}>", element, text.substr(open + mark.size(), close - open - mark.size()));
    from = close + mark.size();
  }
  return html + text.substr(from);
}

// A caption in HTML. Its Markdown is a paragraph with **strong** words and `code`; pictures in it are left out.
std::string caption(const fs::path &markdown) {
  std::istringstream lines(capsule::read_file(markdown));
  std::string text;
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with("!["))
      text += line + "\n";
  return marked(marked(escaped(text), "**", "strong"), "`", "code");
}

std::string base64(const std::string &bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned three = 0;
    for (std::size_t k = i; k < i + 3; ++k)
      three = three << 8U | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63U];
  }
  return text;
}

// A cell that starts with a verdict has its colour; published values look different from computed ones.
std::string table_cell(const std::string &column, const std::string &text) {
  if (column.starts_with("published"))
    return fmt::format("<td class=\"published\">{}</td>", escaped(text));
  const std::array<std::pair<std::string, std::string>, 3> verdicts = {
      {{"agrees", "agrees"}, {"differs", "differs"}, {"not decidable", "open"}}};
  for (const auto &[verdict, style] : verdicts)
    if (text.starts_with(verdict))
      return fmt::format("<td class=\"{}\">{}</td>", style, escaped(text));
  return fmt::format("<td>{}</td>", escaped(text));
}

// The columns that are wanted, in this order, or all columns of the file.
std::string table(const fs::path &csv, const std::vector<std::string> &wanted = {}) {
  const std::vector<capsule::CsvRow> rows = capsule::read_csv(csv);
  const std::vector<std::string> names = rows.empty() ? std::vector<std::string>() : rows[0].fields;
  std::vector<std::size_t> columns;
  columns.reserve(names.size());
  for (const std::string &name : wanted)
    columns.push_back(static_cast<std::size_t>(std::ranges::find(names, name) - names.begin()));
  for (std::size_t k = 0; wanted.empty() && k < names.size(); ++k)
    columns.push_back(k);
  std::string html = "<div class=\"table\" tabindex=\"0\"><table>\n<thead><tr>";
  for (const std::size_t k : columns)
    html += fmt::format("<th scope=\"col\">{}</th>", escaped(names.at(k)));
  html += "</tr></thead>\n<tbody>\n";
  for (std::size_t i = 1; i < rows.size(); ++i) {
    html += "<tr>";
    for (const std::size_t k : columns)
      html += table_cell(names.at(k), rows[i].fields.at(k));
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

// The columns of tables/ledger.csv that the page shows.
std::string ledger() {
  const fs::path csv = "tables/ledger.csv";
  return fs::exists(csv) ? table(csv, {"claim", "where", "statement", "verdict", "published", "converged",
                                       "own error", "distance", "reading and evidence"})
                         : "<p>Not computed yet.</p>";
}

// The question of a case or study: the first line of its README.md, or its name if it has none.
std::string question(const fs::path &directory) {
  const fs::path readme = directory / "README.md";
  if (!fs::exists(readme))
    return escaped(directory.filename());
  const std::string text = capsule::read_file(readme), line = text.substr(0, text.find('\n'));
  return marked(escaped(line.substr(line.find_first_not_of("# "))), "`", "code");
}

// The figures of a case or study, each with its caption, and the comparison of its numbers.
std::string chapter(const fs::path &directory) {
  const std::string id = directory.filename();
  std::string html;
  for (const fs::path &picture : files_of(fs::path("figures") / id, ".svg")) {
    const std::string text = caption(fs::path(picture).replace_extension(".md"));
    // They are drawn for a printed column; the page shows them 1.5 times as large.
    html +=
        fmt::format("<figure><img alt=\"{}\" "
                    "srcset=\"data:image/svg+xml;base64,{} 0.67x\">\n<figcaption>{}</figcaption></figure>\n",
                    escaped(picture.stem()), base64(capsule::read_file(picture)), text);
  }
  if (const fs::path csv = fs::path("tables") / (id + ".csv"); fs::exists(csv))
    html += fmt::format("<details><summary>Computed against published values</summary>\n{}</details>\n",
                        table(csv));
  return html.empty() ? ""
                      : fmt::format("<article id=\"{}\"><h3>{}</h3>\n{}<p class=\"note\">{}</p></article>\n",
                                    escaped(id), question(directory), html, escaped(directory.string()));
}

// The tables of the paper, computed beside published values: tables/table<n>.csv, which the cases' figures write.
std::string paper_tables() {
  std::string html;
  for (const fs::path &csv : files_of("tables", ".csv"))
    if (const std::string id = csv.stem(); id.size() == 6 && id.starts_with("table"))
      html += fmt::format("<h3 id=\"{0}\">Table {1}</h3>\n{2}", id, id.back(), table(csv));
  return html;
}

// The directories of the finished marches of all cases; a run that several cases share counts once.
std::vector<fs::path> finished_runs(const std::vector<fs::path> &cases) {
  std::vector<fs::path> runs;
  std::map<std::string, fs::path> known;
  for (const fs::path &directory : cases) {
    const fs::path results = fs::path("results") / directory.filename();
    std::vector<fs::path> found;
    if (fs::is_directory(results))
      for (const fs::directory_entry &entry : fs::recursive_directory_iterator(results))
        if (entry.path().filename() == "run.json" && fs::exists(entry.path().parent_path() / "summary.json"))
          found.push_back(entry.path().parent_path());
    std::ranges::sort(found);
    for (const fs::path &run : found) {
      const Json origin = Json::parse(capsule::read_file(run / "run.json"));
      if (origin.value("task", "run") == "run" && known.emplace(origin.at("identity"), run).second)
        runs.push_back(run);
    }
  }
  return runs;
}

std::string run_name(const fs::path &run) {
  return fs::relative(run, "results").string();
}

std::string provenance(const std::vector<fs::path> &runs) {
  std::string html = "<div class=\"table\" tabindex=\"0\"><table>\n<thead><tr>";
  for (const char *name : {"run", "status", "steps", "CPU seconds", "estimated error of ΔP", "identity",
                           "commit", "compiler", "flags", "processor"})
    html += fmt::format("<th scope=\"col\">{}</th>", name);
  html += "</tr></thead>\n<tbody>\n";
  for (const fs::path &run : runs) {
    const Json summary = Json::parse(capsule::read_file(run / "summary.json"));
    const Json origin = Json::parse(capsule::read_file(run / "run.json"));
    const Json &estimates = summary.at("error_estimate");
    std::vector<std::string> cells = {run_name(run), summary.at("status"), summary.at("steps").dump(),
                                      fmt::format("{:.1f}", summary.at("cpu_seconds").get<double>()),
                                      estimates.contains("pressure_drop")
                                          ? fmt::format("{:.1e}", estimates["pressure_drop"].get<double>())
                                          : ""};
    for (const char *key : {"identity", "git_commit", "compiler", "flags", "processor"})
      cells.push_back(origin.at(key));
    html += "<tr>";
    for (const std::string &text : cells)
      html += fmt::format("<td>{}</td>", escaped(text));
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

// With as many digits as a picture needs.
double rounded(double value) {
  return std::round(value * 1e4) / 1e4;
}
Json rounded(const std::vector<double> &values) {
  Json numbers = Json::array();
  for (const double value : values)
    numbers.push_back(rounded(value));
  return numbers;
}

struct PlayerField {
  std::string column, name;
  double neutral; // the value of the undeformed membrane
};
const std::vector<PlayerField> player_fields = {{"stretch_meridional", "stretch along the meridian", 1},
                                                {"stretch_azimuthal", "stretch around the axis", 1},
                                                {"tension_meridional", "tension along the meridian", 0},
                                                {"tension_azimuthal", "tension around the axis", 0}};

// The rows at which the profiles of a run begin, in the order in which they were taken, and the end of the last one.
std::vector<std::size_t> profile_bounds(const std::vector<double> &time) {
  std::vector<std::size_t> bounds;
  for (std::size_t i = 0; i < time.size(); ++i)
    if (i == 0 || time[i] != time[i - 1])
      bounds.push_back(i);
  bounds.push_back(time.size());
  return bounds;
}

// A capsule in a frame of the player: the profile in the rows from `first` to before `last`.
Json player_capsule(const capsule::Columns &profiles, std::size_t first, std::size_t last) {
  constexpr std::size_t most_points = 128; // of a profile; the eye sees no more
  const std::size_t stride = 1 + (last - first) / most_points;
  const auto part = [&](const std::string &name) {
    const std::vector<double> &whole = profiles.at(name);
    std::vector<double> thinned;
    for (std::size_t i = first; i + 1 < last; i += stride)
      thinned.push_back(whole[i]);
    thinned.push_back(whole[last - 1]);
    return rounded(thinned);
  };
  Json fields = Json::array();
  for (const PlayerField &field : player_fields)
    fields.push_back(part(field.column));
  return {{"x", part("x")}, {"r", part("r")}, {"fields", fields}};
}

// The frames of a run with all its capsules, whose profiles are of the same times; empty if there are too few to be played.
Json player_frames(const fs::path &run) {
  constexpr std::size_t fewest_frames = 20;
  Json frames = Json::array();
  for (std::size_t capsule = 1;; ++capsule) {
    const fs::path file = run / (capsule == 1 ? "profiles.csv" : fmt::format("profiles-{}.csv", capsule));
    if (!fs::exists(file))
      return frames;
    const capsule::Columns profiles = capsule::read_columns(file);
    const std::vector<std::size_t> bounds = profile_bounds(profiles.at("time"));
    if (bounds.size() <= fewest_frames)
      return frames;
    for (std::size_t k = 0; k + 1 < bounds.size(); ++k) {
      if (capsule == 1)
        frames.push_back({{"time", rounded(profiles.at("time")[bounds[k]])},
                          {"x_g", rounded(profiles.at("x_g")[bounds[k]])},
                          {"capsules", Json::array()}});
      frames.at(k).at("capsules").push_back(player_capsule(profiles, bounds[k], bounds[k + 1]));
    }
  }
}

// Which capsule in which flow: "sphere, Skalak C = 0, R_eq = 0.9, ε = 0.04, λ = 10". Where several differ, what each has.
std::string capsule_name(const Json &parameters) {
  const auto values = [&](const std::string &key) {
    const Json &value = parameters.at(key);
    return value.is_array() ? value : Json::array({value});
  };
  const auto number = [&](const std::string &key) {
    std::vector<std::string> texts;
    for (const Json &value : values(key))
      texts.push_back(capsule::number_text(value.get<double>()));
    return fmt::format("{}", fmt::join(texts, " and "));
  };
  const Json &aspect_ratio = parameters.at("capsule.aspect_ratio");
  std::string name = aspect_ratio.is_null() ? "biconcave"
                     : aspect_ratio == 1.0  ? "sphere"
                                            : "spheroid A/B = " + number("capsule.aspect_ratio");
  const Json laws_there = values("membrane.law");
  for (const capsule::Law *law : capsule::laws())
    if (std::ranges::find(laws_there, Json(law->name)) != laws_there.end()) {
      name += fmt::format(", {}", law->title);
      for (const capsule::LawParameter &declared : law->parameters)
        name += fmt::format(" {} = {}", declared.symbol, number(std::string("membrane.") + declared.name));
    }
  name += fmt::format(", R_eq = {}, ε = {}, λ = {}", number("capsule.radius"),
                      number("flow.capillary_number"), number("flow.viscosity_ratio"));
  const Json &nodes = parameters.at("mesh.membrane");
  return nodes.is_null() ? name : fmt::format("{}, {} nodes", name, nodes.dump());
}

// The runs that have enough profiles to be played.
std::string player_data(const std::vector<fs::path> &runs) {
  Json played = Json::array();
  for (const fs::path &run : runs) {
    const Json frames = player_frames(run);
    if (frames.empty())
      continue;
    const Json parameters = Json::parse(capsule::read_file(run / "summary.json")).at("parameters");
    const Json &shape = parameters.at("pore.shape");
    if (shape.is_null() || shape == "none") // an extension, without walls
      continue;
    const Json &opening_angle = parameters.at("pore.opening_angle_deg"); // a tube has none
    const Json &title = parameters.at("title");
    const capsule::Columns series = capsule::read_columns(run / "series.csv");
    played.push_back(
        {{"case", title.is_null() ? run.parent_path().filename().string() : title.get<std::string>()},
         {"name", capsule_name(parameters)},
         {"opening_angle",
          opening_angle.is_null() ? 0 : opening_angle.get<double>() * std::numbers::pi / 180},
         {"second_mouth", shape == "two-mouths" ? parameters.at("pore.exit_x") : Json()},
         {"series",
          {{"x_g", rounded(series.at("x_g"))}, {"pressure_drop", rounded(series.at("pressure_drop"))}}},
         {"frames", frames}});
  }
  Json fields = Json::array();
  for (const PlayerField &field : player_fields)
    fields.push_back({{"name", field.name}, {"neutral", field.neutral}});
  return Json({{"fields", fields}, {"runs", played}}).dump();
}

// The frame with each @name@ replaced by its part.
std::string filled(const std::string &frame, const std::map<std::string, std::string> &parts) {
  std::string page;
  std::size_t from = 0;
  while (true) {
    const std::size_t open = frame.find('@', from);
    const std::size_t close = open == std::string::npos ? open : frame.find('@', open + 1);
    if (close == std::string::npos)
      return page + frame.substr(from);
    page += frame.substr(from, open - from) + parts.at(frame.substr(open + 1, close - open - 1));
    from = close + 1;
  }
}

void write_page(const fs::path &page, const std::vector<fs::path> &directories) {
  std::string of_the_paper, others, studies;
  for (const fs::path &directory : directories) {
    const bool is_case = directory.parent_path().filename() == "cases";
    const bool is_item = is_case && !capsule::read_case(directory).runs.front().physics.paper.empty();
    (is_item ? of_the_paper : is_case ? others : studies) += chapter(directory);
  }
  const std::vector<fs::path> runs = finished_runs(directories);
  const fs::path source = REPORT_SOURCE;
  const std::string html =
      filled(capsule::read_file(source / "page.html"), {{"style", capsule::read_file(source / "style.css")},
                                                        {"script", capsule::read_file(source / "player.js")},
                                                        {"ledger", ledger()},
                                                        {"tables", paper_tables()},
                                                        {"cases", of_the_paper + others},
                                                        {"studies", studies},
                                                        {"provenance", provenance(runs)},
                                                        {"player", player_data(runs)}});
  capsule::write_atomically(page, html);
}

} // namespace

int main(int argc, char **argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: report_page PAGE DIRECTORY...\n");
    return 2;
  }
  try {
    write_page(argv[1], {argv + 2, argv + argc});
  } catch (const std::exception &error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 4;
  }
  return 0;
}
