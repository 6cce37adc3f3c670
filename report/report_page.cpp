// Writes the report: one HTML page that contains everything and loads nothing.
//   report_page PAGE DIRECTORY...
// writes PAGE. Each DIRECTORY is a case, cases/<id>, or a study, validation/<id>. Its figures, comparison and results are
// read from figures/<id>/, tables/<id>.csv and results/<id>/, where `make figures` and `make atlas` write them; what has
// not been computed yet is named with the command that does it. The page's frame, style and scripts are beside this file.
#include "base/atomic_file.hpp"
#include "base/csv.hpp"
#include "base/text.hpp"
#include "case/case_file.hpp"
#include "claims.hpp"
#include "html.hpp"
#include "player_data.hpp"
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace report {
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

// The question of a case or study: the first line of its README.md, or its name if it has none.
std::string question(const fs::path &directory) {
  const fs::path readme = directory / "README.md";
  if (!fs::exists(readme))
    return escaped(directory.filename().string());
  const std::string text = capsule::read_file(readme), line = text.substr(0, text.find('\n'));
  return prose(line.substr(line.find_first_not_of("# ")));
}

// A part of the page, what its list of contents says of it, and what is missing in it.
struct Part {
  std::string html;
  std::map<std::string, std::string> contents; // figures of the paper by their numbers, others by their cases
  std::string missing;
};

// A caption's name, "Figure 5a", what it is of, and all of it.
struct Caption {
  std::string name, subject, whole;
};
Caption caption_of(const fs::path &picture) {
  const std::string opening = "<strong>", closing = ".</strong>";
  const std::string whole = caption(fs::path(picture).replace_extension(".md"));
  const std::size_t from = whole.find(opening), to = whole.find(closing);
  if (from == std::string::npos || to == std::string::npos)
    return {escaped(picture.stem().string()), "", whole};
  const std::size_t sentence = to + closing.size();
  std::size_t end = whole.size();
  for (const char *stop : {". ", ".\n", ": ", " ("})
    end = std::min(end, whole.find(stop, sentence));
  return {whole.substr(from + opening.size(), to - from - opening.size()),
          whole.substr(sentence, end - sentence), whole};
}

// A figure with its caption. It is drawn for a printed column; the page shows it 1.5 times as large.
Part figure(const fs::path &picture, const std::string &id) {
  const Caption text = caption_of(picture);
  const std::string stem = picture.stem().string(), anchor = escaped(id + "-" + stem);
  const bool is_of_the_paper = text.name.starts_with("Figure ");
  return {fmt::format("<figure id=\"{0}\"><button type=\"button\" class=\"enlarge\" title=\"Enlarge\">"
                      "<img alt=\"{1}\" srcset=\"data:image/svg+xml;base64,{2} 0.67x\"></button>\n"
                      "<figcaption>{3}</figcaption></figure>\n",
                      anchor, text.name, base64(capsule::read_file(picture)), text.whole),
          {{is_of_the_paper ? stem : id + "-" + stem,
            fmt::format("<li><a href=\"#{}\">{}</a>{}</li>\n", anchor, text.name, text.subject)}},
          ""};
}

// Numbers of a case or study beside those that are expected; open where one is not as recorded.
std::string comparison(const fs::path &csv) {
  const std::vector<capsule::CsvRow> lines = capsule::read_csv(csv);
  const auto verdict =
      lines.empty() ? 0 : std::ranges::find(lines[0].fields, "verdict") - lines[0].fields.begin();
  const auto failed = std::ranges::count_if(lines, [&](const capsule::CsvRow &line) {
    return verdict_style(line.fields.at(static_cast<std::size_t>(verdict))) == "failed";
  });
  return fmt::format("<details{}><summary>Computed against expected values{}</summary>\n{}</details>\n",
                     failed > 0 ? " open" : "",
                     failed > 0 ? fmt::format(": <span class=\"failed\">{} of {} not as recorded</span>",
                                              failed, capsule::counted(lines.size() - 1, "row"))
                                : "",
                     table(csv));
}

// The figures of a case or study, and the comparison of its numbers.
Part chapter(const fs::path &directory, bool is_case) {
  const std::string id = directory.filename();
  Part part;
  for (const fs::path &picture : files_of(fs::path("figures") / id, ".svg")) {
    Part one = figure(picture, id);
    part.html += one.html;
    part.contents.merge(one.contents);
  }
  if (const fs::path csv = fs::path("tables") / (id + ".csv"); fs::exists(csv))
    part.html += comparison(csv);
  if (part.html.empty())
    part.missing = fmt::format("<li>{} <code>cmake --build build --target {}-{}</code></li>\n",
                               question(directory), is_case ? "figure" : "study", escaped(id));
  else
    part.html = fmt::format("<article id=\"{}\"><h3>{}</h3>\n{}<p class=\"note\">{}</p></article>\n",
                            escaped(id), question(directory), part.html, escaped(directory.string()));
  return part;
}

std::string contents_list(const Part &part) {
  std::string items;
  for (const auto &[name, item] : part.contents)
    items += item;
  return items.empty() ? "" : fmt::format("<ul class=\"contents\">\n{}</ul>\n", items);
}

std::string missing_list(const std::string &items, const std::string &command) {
  return items.empty()
             ? ""
             : fmt::format("<p>Not computed yet; <code>{}</code> makes all of them:</p>\n<ul>{}</ul>\n",
                           command, items);
}

// The tables of the paper, computed beside published values: tables/table<n>.csv, which the cases' figures write.
Part paper_tables() {
  Part part;
  for (const fs::path &csv : files_of("tables", ".csv"))
    if (const std::string id = csv.stem(); id.size() == 6 && id.starts_with("table")) {
      part.html += fmt::format("<h3 id=\"{0}\">Table {1}</h3>\n{2}", id, id.back(), table(csv));
      part.contents[id] =
          fmt::format("<li><a href=\"#{0}\">Table {1}</a> beside the published one</li>\n", id, id.back());
    }
  return part;
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

std::string provenance(const std::vector<fs::path> &runs) {
  std::vector<std::vector<std::string>> rows{{"run", "status", "steps", "CPU seconds",
                                              "estimated error of ΔP", "identity", "commit", "compiler",
                                              "flags", "processor"}};
  for (const fs::path &run : runs) {
    const Json summary = Json::parse(capsule::read_file(run / "summary.json"));
    const Json origin = Json::parse(capsule::read_file(run / "run.json"));
    const Json &estimates = summary.at("error_estimate");
    rows.push_back({fs::relative(run, "results").string(), summary.at("status"), summary.at("steps").dump(),
                    fmt::format("{:.1f}", summary.at("cpu_seconds").get<double>()),
                    estimates.contains("pressure_drop")
                        ? fmt::format("{:.1e}", estimates["pressure_drop"].get<double>())
                        : ""});
    for (const char *key : {"identity", "git_commit", "compiler", "flags", "processor"})
      rows.back().push_back(origin.at(key));
  }
  return table(rows);
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
  Part of_the_paper = paper_tables(), others, studies;
  std::string missing_cases;
  for (const fs::path &directory : directories) {
    const bool is_case = directory.parent_path().filename() == "cases";
    const bool is_item = is_case && !capsule::read_case(directory).runs.front().physics.paper.empty();
    Part one = chapter(directory, is_case);
    Part &section = is_item ? of_the_paper : is_case ? others : studies;
    section.html += one.html;
    section.contents.merge(one.contents);
    (is_case ? missing_cases : studies.missing) += one.missing;
  }
  const std::vector<fs::path> runs = finished_runs(directories);
  const fs::path source = REPORT_SOURCE;
  const auto file = [&](const char *name) { return capsule::read_file(source / name); };
  const std::string html =
      filled(file("page.html"), {{"style", file("style.css")},
                                 {"player script", file("player.js")},
                                 {"page script", file("page.js")},
                                 {"claims", claims("tables/ledger.csv", directories)},
                                 {"figures", contents_list(of_the_paper)},
                                 {"items of the paper", of_the_paper.html},
                                 {"other figures", contents_list(others)},
                                 {"cases", others.html},
                                 {"missing cases", missing_list(missing_cases, "make figures")},
                                 {"study figures", contents_list(studies)},
                                 {"studies", studies.html},
                                 {"missing studies", missing_list(studies.missing, "make atlas")},
                                 {"provenance", provenance(runs)},
                                 {"player", player_data(runs).dump()}});
  capsule::write_atomically(page, html);
}

} // namespace
} // namespace report

int main(int argc, char **argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: report_page PAGE DIRECTORY...\n");
    return 2;
  }
  try {
    report::write_page(argv[1], {argv + 2, argv + argc});
  } catch (const std::exception &error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 4;
  }
  return 0;
}
