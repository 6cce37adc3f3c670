#include "program/workers.hpp"
#include "base/failure.hpp"
#include "program/exit_code.hpp"
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
#include <string>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>

namespace capsule {
namespace {

void keep_text(const char *text, char (&place)[1000]) {
  std::strncpy(place, text, sizeof place - 1);
  place[sizeof place - 1] = '\0';
}

// All that a child process does.
[[noreturn]] void work_on(std::size_t index, const Work &work, SharedState &shared, pid_t parent) {
  // A child whose parent dies saves what it has and stops.
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent)
    shared.stop();
  Progress &progress = shared.progress(index);
  const ExitCode code = [&] {
    try {
      progress.result = work.task(index);
      return ExitCode::done;
    } catch (const InputError &error) {
      keep_text(error.what(), progress.error);
      return ExitCode::bad_input;
    } catch (const FileError &error) {
      keep_text(error.what(), progress.error);
      return ExitCode::files_failed;
    } catch (const std::system_error &error) { // of files or of standard output
      keep_text(error.what(), progress.error);
      return ExitCode::files_failed;
    } catch (const std::exception &error) {
      keep_text(error.what(), progress.error);
      return ExitCode::numerics_failed;
    }
  }();
  std::fflush(stdout);
  _exit(static_cast<int>(code));
}

std::exception_ptr file_error(const std::string &text) {
  return std::make_exception_ptr(FileError(text));
}

std::string signal_text(int signal) {
  return fmt::format("its process was ended by signal {} ({}){}", signal, strsignal(signal),
                     signal == SIGKILL ? ", as it may be where memory is short; try fewer --jobs" : "");
}

// What a child's end, as `waitpid` tells it, means for its parent: nothing if it is done.
std::exception_ptr failure_of(int status, const char *error) {
  if (WIFSIGNALED(status))
    return file_error(signal_text(WTERMSIG(status)));
  switch (static_cast<ExitCode>(WEXITSTATUS(status))) {
  case ExitCode::done:
    return nullptr;
  case ExitCode::bad_input:
    return std::make_exception_ptr(InputError(error));
  case ExitCode::files_failed:
    return file_error(error);
  default:
    return std::make_exception_ptr(std::runtime_error(error));
  }
}

} // namespace

SharedState::SharedState(std::size_t tasks) : bytes_(sizeof(Progress) * (tasks + 1)) {
  memory_ = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory_ == MAP_FAILED)
    throw std::bad_alloc();
  progress_ = static_cast<Progress *>(memory_);
  std::uninitialized_value_construct_n(progress_, tasks);
  stopping_ = new (progress_ + tasks) std::atomic<bool>(false);
}

SharedState::~SharedState() {
  munmap(memory_, bytes_);
}

void run_in_processes(const Work &work, SharedState &shared) {
  // Where the signal is inherited as ignored, children vanish without a status.
  std::signal(SIGCHLD, SIG_DFL);
  const pid_t parent = getpid();
  std::map<pid_t, std::size_t> children;
  std::size_t next = 0;
  while (!children.empty() || (next < work.tasks && !shared.stops())) {
    if (children.size() < work.jobs && next < work.tasks && !shared.stops()) {
      std::fflush(stdout);
      const pid_t child = fork();
      if (child == 0)
        work_on(next, work, shared, parent);
      if (child > 0)
        children[child] = next++;
      else if (children.empty()) // otherwise there may be room when one of them has ended
        work.failed(next++, file_error(fmt::format("cannot start a process: {}", std::strerror(errno))));
      if (child > 0 || children.empty())
        continue;
    }
    work.watch();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    for (auto child = children.begin(); child != children.end();) {
      const auto [process, task] = *child;
      int status = 0;
      const pid_t ended = waitpid(process, &status, WNOHANG);
      if (ended == 0 || (ended < 0 && errno == EINTR)) {
        ++child;
        continue;
      }
      child = children.erase(child);
      const Progress &progress = shared.progress(task);
      if (ended < 0)
        work.failed(task, file_error(fmt::format("its process is lost: {}", std::strerror(errno))));
      else if (const auto failure = failure_of(status, progress.error))
        work.failed(task, failure);
      else
        work.finished(task, progress.result);
    }
  }
}

} // namespace capsule
