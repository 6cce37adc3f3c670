// libFuzzer: any bytes as the profiles.csv that `capsule steady --from` begins with.
#include "observe/quantities.hpp"
#include "output/tables.hpp"
#include "reading.hpp"
#include <cstddef>
#include <cstdint>

using namespace capsule;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  write_scratch(scratch_directory() / "profiles.csv", {reinterpret_cast<const char *>(data), size});
  check_refusal([] {
    const Profile profile = read_last_profile(scratch_directory());
    for (const ProfileQuantity &quantity : profile_quantities()) {
      const Vector &values = profile.*quantity.values;
      if (values.size() != profile.S.size() || values.size() == 0 || !values.allFinite())
        finding("a profile that is no profile");
    }
    if ((profile.S.tail(profile.S.size() - 1).array() <= profile.S.head(profile.S.size() - 1).array()).any())
      finding("points of the meridian out of their order");
  });
  return 0;
}
