// Files whole or not there: writers that are killed, at once, and without room.
#include "base/atomic_file.hpp"
#include "temporary_directory.hpp"
#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>
#include <csignal>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

using namespace capsule;
namespace fs = std::filesystem;

BOOST_AUTO_TEST_CASE(files_are_whole_or_not_there) {
  const TemporaryDirectory directory;
  const fs::path file = directory.path / "a.txt";
  write_atomically(file, "first");
  write_atomically(file, "second");
  BOOST_TEST(content_of(file) == "second");
  BOOST_TEST(entries_in(directory.path) == 1u);

  BOOST_TEST(failure_of([&] { write_atomically(directory.path / "none" / "a.txt", "x"); }) ==
             "cannot write '" + (directory.path / "none" / "a.txt").string() +
                 "': No such file or directory");
  // A directory stands where the file should go: nothing is left behind.
  fs::create_directories(directory.path / "taken" / "b.txt" / "c");
  BOOST_TEST(failure_of([&] { write_atomically(directory.path / "taken" / "b.txt", "x"); }) != "no error");
  BOOST_TEST(entries_in(directory.path / "taken") == 1u);
  BOOST_TEST(failure_of([&] { make_directories(file / "below"); }).find("a.txt/below") != std::string::npos);
  BOOST_TEST(failure_of([&] { write_atomically("/proc/self/a.txt", "x"); }).find("/proc/self/a.txt") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(what_a_killed_writer_leaves_is_overwritten) {
  const TemporaryDirectory directory;
  const fs::path file = directory.path / "a.txt", left = directory.path / ".writing-a.txt";
  std::ofstream(left) << "longer than what comes";
  write_atomically(file, "whole");
  BOOST_TEST(content_of(file) == "whole");
  BOOST_TEST(entries_in(directory.path) == 1u);

  // A writer that lives keeps its own.
  std::ofstream(left) << "of another";
  const int other = open(left.c_str(), O_RDONLY | O_CLOEXEC);
  BOOST_REQUIRE(flock(other, LOCK_EX) == 0);
  write_atomically(file, "once more");
  BOOST_TEST(content_of(file) == "once more");
  BOOST_TEST(content_of(left) == "of another");
  BOOST_TEST(entries_in(directory.path) == 2u);
  close(other);
}

// While many processes write one file, whoever reads finds one text or the other, whole.
BOOST_AUTO_TEST_CASE(writers_at_once) {
  const TemporaryDirectory directory;
  const fs::path file = directory.path / "a.txt";
  const std::array texts{std::string(3000, 'a'), std::string(5, 'b'), std::string(70000, 'c')};
  write_atomically(file, texts[0]);
  std::vector<pid_t> writers;
  for (const std::string &text : texts) {
    const pid_t writer = fork();
    if (writer == 0) {
      try {
        for (int i = 0; i < 50; ++i)
          write_atomically(file, text);
        _exit(0);
      } catch (const FileError &) {
        _exit(1);
      }
    }
    writers.push_back(writer);
  }
  for (int i = 0; i < 50; ++i) {
    const std::string seen = content_of(file);
    BOOST_TEST((std::ranges::find(texts, seen) != texts.end()));
  }
  for (const pid_t writer : writers) {
    int status = 0;
    BOOST_TEST(waitpid(writer, &status, 0) == writer);
    BOOST_TEST(status == 0);
  }
  BOOST_TEST(entries_in(directory.path) == 1u);
}

BOOST_AUTO_TEST_CASE(a_file_size_limit_leaves_nothing_half_written) {
  const TemporaryDirectory directory;
  const fs::path file = directory.path / "a.txt";
  write_atomically(file, "old");
  rlimit before{};
  BOOST_REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
  const rlimit small{4096, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  BOOST_REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
  const std::string failure = failure_of([&] { write_atomically(file, std::string(10000, 'x')); });
  BOOST_REQUIRE(setrlimit(RLIMIT_FSIZE, &before) == 0);
  std::signal(SIGXFSZ, handler);
  BOOST_TEST(failure == "cannot write '" + file.string() + "': File too large");
  BOOST_TEST(content_of(file) == "old");
  BOOST_TEST(entries_in(directory.path) == 1u);
}
