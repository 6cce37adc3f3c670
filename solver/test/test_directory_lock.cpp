// A directory's lock: one holder at a time, released with the object and with the process.
#include "base/directory_lock.hpp"
#include "temporary_directory.hpp"
#include <boost/test/unit_test.hpp>
#include <csignal>
#include <optional>
#include <sys/wait.h>

using namespace capsule;

BOOST_AUTO_TEST_CASE(one_holder_at_a_time) {
  const TemporaryDirectory directory, another;
  std::optional<DirectoryLock> first(directory.path);
  const DirectoryLock second(directory.path);
  BOOST_TEST(first->acquire());
  BOOST_TEST(first->acquire()); // again
  BOOST_TEST(!second.acquire());
  BOOST_TEST(DirectoryLock(another.path).acquire());
  first.reset();
  BOOST_TEST(second.acquire());
}

BOOST_AUTO_TEST_CASE(a_killed_process_holds_nothing) {
  const TemporaryDirectory directory;
  int ready[2];
  BOOST_REQUIRE(pipe(ready) == 0);
  const pid_t child = fork();
  if (child == 0) {
    const DirectoryLock held(directory.path);
    const char answer = held.acquire() ? 'y' : 'n';
    if (write(ready[1], &answer, 1) == 1)
      pause();
    _exit(1);
  }
  char answer = '?';
  BOOST_TEST(read(ready[0], &answer, 1) == 1);
  BOOST_TEST(answer == 'y');
  const DirectoryLock lock(directory.path);
  BOOST_TEST(!lock.acquire());
  kill(child, SIGKILL);
  BOOST_TEST(waitpid(child, nullptr, 0) == child);
  BOOST_TEST(lock.acquire());
  close(ready[0]);
  close(ready[1]);
}
