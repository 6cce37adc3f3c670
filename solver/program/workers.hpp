#pragma once
// Tasks in processes of their own, several at a time. Not in threads, because a serial build of OpenBLAS keeps its work
// space in global memory: two threads in it spoil each other's numbers without a sign.
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>

namespace capsule {

// What a task's process tells the first process.
struct Progress {
  std::atomic<double> time, x_g;
  std::atomic<long> steps;  // 0: nothing yet
  std::atomic<double> work; // of a search for a steady state (Control::spend)
  std::atomic<int> result;  // of the task
  char error[1000];         // what it threw
};

// Memory that all processes see.
class SharedState {
public:
  explicit SharedState(std::size_t tasks);
  ~SharedState();
  SharedState(const SharedState &) = delete;
  SharedState &operator=(const SharedState &) = delete;

  Progress &progress(std::size_t task) { return progress_[task]; }

  // Asks all tasks to stop.
  void stop() { *stopping_ = true; }
  bool stops() const { return *stopping_; }

private:
  std::size_t bytes_;
  void *memory_;
  std::atomic<bool> *stopping_;
  Progress *progress_;
};

struct Work {
  std::size_t tasks = 0;
  unsigned jobs = 1;                              // processes at a time
  std::function<int(std::size_t)> task;           // called in a child process
  std::function<void()> watch;                    // called here, some times per second
  std::function<void(std::size_t, int)> finished; // called here with the task's result
  // Called here with what the task threw: InputError, FileError, or std::runtime_error for anything else. A task whose
  // process was ended by a signal or could not be started has thrown a FileError.
  std::function<void(std::size_t, const std::exception_ptr &)> failed;
};

// Starts all tasks in order, until they are asked to stop. A task that fails stops no other. Throws what the callbacks
// throw.
void run_in_processes(const Work &work, SharedState &shared);

} // namespace capsule
