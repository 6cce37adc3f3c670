// The main program of every unit test (Boost.Test, dynamic library).
#define BOOST_TEST_MODULE solver
#include <boost/test/unit_test.hpp>
