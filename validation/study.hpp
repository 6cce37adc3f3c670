#pragma once
// What the studies of validation/ share: computing runs several at a time, and comparing their histories.
#include "base/atomic_file.hpp"
#include "program/case_runs.hpp"
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace capsule {

// The main function of a study. The program has two arguments, the directory for the study's files and the number of jobs.
// Returns the exit code: 0 if the study returns that its claims hold, 1 if not, 2 for wrong arguments, 3 for an exception,
// which is printed.
int study_main(int argc, char **argv,
               const std::function<bool(const std::string &directory, unsigned jobs)> &study);

// The input of the first run of cases/<name>.
Case physics_of(const std::string &case_name);
// Table 1's sphere at accuracy 1e-3 on this number of nodes, from x_g = -2.5 to `end` in a pore that ends at x = 8.
Case short_entrance(int nodes, double end);

// Columns of series.csv.
using History = std::map<std::string, std::vector<double>>;
// The columns that studies compare: time, x_g, v_g, pressure_drop, volume_change.
History history_of(const std::vector<SeriesRow> &series);

struct StudyRun {
  Summary summary;
  History history;
};

// Which runs are used again if they are there: those of this same program, or those of any version, which are good enough
// as references.
enum class Found { of_this_program, of_any };

// Computes the runs that are not there yet, `jobs` at a time; results go to directory/<name of the run>. Throws what
// `compute` throws, and a FileError if a run was interrupted.
std::vector<StudyRun> run_all(const std::string &directory, unsigned jobs, const std::vector<RunInput> &runs,
                              Found found = Found::of_this_program);

// The texts that tasks make, in the order of the tasks. Each runs in a process of its own, `jobs` at a time. Texts are kept
// in directory/parts and used again by the same program.
struct TextTask {
  std::string name; // of the file that keeps its text
  std::function<std::string()> make;
};
std::vector<std::string> make_all(const std::string &directory, unsigned jobs,
                                  const std::vector<TextTask> &tasks);

// Rows of comma-separated fields, as tasks make them, one a line, read by the names of their columns. A row may have fewer
// fields than there are names.
class Rows {
public:
  Rows(const std::string &header, const std::string &text);
  std::size_t size() const { return rows_.size(); }
  // Throws std::out_of_range if there is no such row or column, or if the row ends before it.
  const std::string &text(std::size_t row, const std::string &column) const;
  // Throws std::invalid_argument, too, if no number is there.
  double value(std::size_t row, const std::string &column) const { return std::stod(text(row, column)); }

private:
  std::map<std::string, std::size_t> columns_;
  std::vector<std::vector<std::string>> rows_;
};

// Reads a run's directory.
StudyRun read_run(const std::filesystem::path &directory);

// Largest difference of a quantity between two histories, over the rows of the second whose x_g is a multiple of 0.05 in
// [from, to]; infinite if the first has no row at one of these x_g.
double history_difference(const History &history, const History &reference, const std::string &quantity,
                          double from, double to);
// The same, relative to the largest absolute value of the second history in [from, to].
double history_error(const History &history, const History &reference, const std::string &quantity,
                     double from, double to);

// CPU time of this process so far.
double cpu_seconds();

// Prints whether a claim of this study holds, and returns whether.
bool check(bool holds, const std::string &claim);

// A header and rows, given without line ends, that are written at once.
class Table {
public:
  explicit Table(const std::string &header) : text_(header + "\n") {}
  void add(const std::string &row) { text_ += row + "\n"; }
  void write(const std::filesystem::path &file) const { write_atomically(file, text_); }

private:
  std::string text_;
};

} // namespace capsule
