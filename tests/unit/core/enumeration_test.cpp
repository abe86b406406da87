// Names and rows for each value of an enumeration.
#include "core/enumeration.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace lockstep {
namespace {

enum class Season : std::uint8_t { Spring, Summer, Autumn, Winter };
struct Owner {
    enum class Kind : std::uint8_t { Person };
};

static_assert(kCountOf<Season> == 4);
static_assert(kCountOf<Owner::Kind> == 1);
static_assert(pick_name({"spring", "summer", "autumn", "winter"}, Season::Autumn) == "autumn");

TEST(Enumeration, AValueOutsideItHasTheNameUnknown) {
    EXPECT_EQ(pick_name({"person"}, Owner::Kind::Person), "person");
    EXPECT_EQ(pick_name({"person"}, static_cast<Owner::Kind>(1)), "unknown");
}

TEST(EnumerationDeathTest, AValueOutsideItHasNoRow) {
    constexpr std::array kDays{92, 92, 91, 90};
    EXPECT_EQ(pick_row(kDays, Season::Winter), 90);
    EXPECT_DEATH(pick_row(kDays, static_cast<Season>(4)), "a value is one of its enumeration");
}

}  // namespace
}  // namespace lockstep
