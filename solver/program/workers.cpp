#include "program/workers.hpp"
#include "base/failure.hpp"
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace capsule {
namespace {

enum ExitCode { done = 0, input_error = 2, file_error = 4, other_error = 5 };

void keep_text(const char *text, char (&place)[1000]) {
  std::strncpy(place, text, sizeof place - 1);
  place[sizeof place - 1] = '\0';
}

// The life of a child process.
[[noreturn]] void work_on(std::size_t index, const Work &work, Crew &crew, pid_t parent) {
  // Without its parent a child saves what it has.
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent)
    crew.stop();
  int code = done;
  try {
    crew.news(index).result = work.task(index);
  } catch (const InputError &error) {
    keep_text(error.what(), crew.news(index).error);
    code = input_error;
  } catch (const FileError &error) {
    keep_text(error.what(), crew.news(index).error);
    code = file_error;
  } catch (const std::exception &error) {
    keep_text(error.what(), crew.news(index).error);
    code = other_error;
  }
  std::fflush(stdout);
  _exit(code);
}

std::exception_ptr failure_of(int status, const char *error) {
  if (WIFSIGNALED(status))
    return std::make_exception_ptr(std::runtime_error(fmt::format(
        "a run's process was ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)))));
  if (WEXITSTATUS(status) == input_error)
    return std::make_exception_ptr(InputError(error));
  if (WEXITSTATUS(status) == file_error)
    return std::make_exception_ptr(FileError(error));
  if (WEXITSTATUS(status) != done)
    return std::make_exception_ptr(std::runtime_error(error));
  return nullptr;
}

} // namespace

Crew::Crew(std::size_t tasks) : bytes(sizeof(News) * (tasks + 1)) {
  memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED)
    throw std::bad_alloc();
  slots = static_cast<News *>(memory);
  std::uninitialized_value_construct_n(slots, tasks);
  stopping = new (slots + tasks) std::atomic<bool>(false);
}

Crew::~Crew() {
  munmap(memory, bytes);
}

void run_in_processes(const Work &work, Crew &crew) {
  // Where it is inherited as ignored, children vanish without a status.
  std::signal(SIGCHLD, SIG_DFL);
  const pid_t parent = getpid();
  std::map<pid_t, std::size_t> children;
  std::exception_ptr first_failure;
  std::size_t next = 0;
  const auto fail = [&](std::exception_ptr failure, bool of_this_task_alone = false) {
    if (!first_failure)
      first_failure = std::move(failure);
    if (!of_this_task_alone)
      crew.stop();
  };
  while (!children.empty() || (next < work.tasks && !crew.stops())) {
    if (children.size() < work.jobs && next < work.tasks && !crew.stops()) {
      std::fflush(stdout);
      const pid_t child = fork();
      if (child == 0)
        work_on(next, work, crew, parent);
      if (child > 0)
        children[child] = next++;
      else
        fail(std::make_exception_ptr(
            std::runtime_error(fmt::format("cannot start a process: {}", std::strerror(errno)))));
      continue;
    }
    work.watch();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    for (auto child = children.begin(); child != children.end();) {
      int status = 0;
      const pid_t ended = waitpid(child->first, &status, WNOHANG);
      if (ended == 0 || (ended < 0 && errno == EINTR)) {
        ++child;
        continue;
      }
      Crew::News &news = crew.news(child->second);
      if (ended < 0)
        fail(std::make_exception_ptr(
            std::runtime_error(fmt::format("a run's process is lost: {}", std::strerror(errno)))));
      else if (auto failure = failure_of(status, news.error))
        fail(std::move(failure), WIFEXITED(status) && WEXITSTATUS(status) == input_error);
      else
        work.finished(child->second, news.result);
      child = children.erase(child);
    }
  }
  if (first_failure)
    std::rethrow_exception(first_failure);
}

} // namespace capsule
