#pragma once
// Tasks in processes of their own, several at a time. Processes and not threads, because a serial build of
// OpenBLAS keeps its work space in global memory: two threads in it spoil each other's numbers without a
// sign.
#include <atomic>
#include <cstddef>
#include <functional>

namespace capsule {

// What the processes see of each other.
class Crew {
public:
  explicit Crew(std::size_t tasks);
  ~Crew();
  Crew(const Crew &) = delete;
  Crew &operator=(const Crew &) = delete;

  // Each task's latest news, from its process to the first one.
  struct News {
    std::atomic<double> time, x_g;
    std::atomic<long> steps; // 0: none yet
    std::atomic<int> result;
    char error[1000];
  };
  News &news(std::size_t task) { return slots[task]; }

  // Asks all tasks to come to an end.
  void stop() { *stopping = true; }
  bool stops() const { return *stopping; }

private:
  std::size_t bytes;
  void *memory;
  std::atomic<bool> *stopping;
  News *slots;
};

struct Work {
  std::size_t tasks = 0;
  unsigned jobs = 1;
  std::function<int(std::size_t)> task;           // called in a child process
  std::function<void()> watch;                    // called here, some times per second
  std::function<void(std::size_t, int)> finished; // called here with the task's result
};

// All tasks in order, as long as the crew is not asked to stop. A FileError or another failure of one task
// stops the others and is thrown when all have ended; so is a task's end by a signal. An InputError is thrown
// then too, but stops no other task.
void run_in_processes(const Work &work, Crew &crew);

} // namespace capsule
