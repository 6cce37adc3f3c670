#pragma once
// What the studies of validation/ share: runs side by side, and histories compared.
#include "base/atomic_file.hpp"
#include "program/case_runs.hpp"
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace capsule {

// The main function of a study: calls it with the program's two arguments, the directory for its files and the
// number of jobs. Exit code 0 if it returns that its claims hold, 1 if not, 2 for wrong arguments, 3 for an
// exception, which is printed.
int study_main(int argc, char **argv,
               const std::function<bool(const std::string &directory, unsigned jobs)> &study);

// What the first run of cases/<name> computes.
Case physics_of(const std::string &case_name);
// Table 1's sphere at accuracy 1e-3 on so many nodes, on a short way: from x_g = -2.5 to `end`, in a pore that ends at 8.
Case short_entrance(int nodes, double end);

// Columns of series.csv.
using History = std::map<std::string, std::vector<double>>;
// Those that studies compare: time, x_g, v_g, pressure_drop, volume_change.
History history_of(const std::vector<SeriesRow> &series);

struct StudyRun {
  Summary summary;
  History history;
};

// Runs that are found computed already: by this same program, or by any version of it, which is good enough for what
// others are measured against.
enum class Found { of_this_program, of_any };

// Computes the runs, `jobs` at a time, or finds them; results go to directory/<name of the run>. Throws what
// `compute` throws, and a FileError if a run was interrupted.
std::vector<StudyRun> run_all(const std::string &directory, unsigned jobs, const std::vector<RunInput> &runs,
                              Found found = Found::of_this_program);

// Text made by tasks in processes of their own, `jobs` at a time, in the order of their names. What this same program has
// made already is found in directory/parts.
struct TextTask {
  std::string name; // of the file that keeps the text
  std::function<std::string()> make;
};
std::vector<std::string> make_all(const std::string &directory, unsigned jobs,
                                  const std::vector<TextTask> &tasks);

// A run's directory read back.
StudyRun read_run(const std::filesystem::path &directory);

// Largest difference of two histories of one quantity over the rows of the second whose x_g is a multiple of 0.05
// and lies in [from, to]; infinite if the first lacks one of them.
double history_difference(const History &history, const History &reference, const std::string &quantity,
                          double from, double to);
// The same relative to the largest value of the second history in [from, to].
double history_error(const History &history, const History &reference, const std::string &quantity,
                     double from, double to);

// Spent by this process so far.
double cpu_seconds();

// Prints whether a claim of this study holds, and returns it.
bool check(bool holds, const std::string &claim);

// Rows under a header, each with its line's end missing, written at once.
class Table {
public:
  explicit Table(const std::string &header) : text_(header + "\n") {}
  void add(const std::string &row) { text_ += row + "\n"; }
  void write(const std::filesystem::path &file) const { write_atomically(file, text_); }

private:
  std::string text_;
};

} // namespace capsule
