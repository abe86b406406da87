#include "core/faults.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

TEST(Faults, EveryFaultHasANameACauseAndARemedy) {
    for (int number = 100; number < 200; ++number) {
        const FaultText* text = find_fault(static_cast<FaultCode>(number));
        if (text == nullptr) { continue; }
        EXPECT_EQ(static_cast<int>(text->code), number);
        EXPECT_FALSE(text->name.empty());
        EXPECT_FALSE(text->cause.empty());
        EXPECT_FALSE(remedy_text(*text).empty());
    }
}

TEST(Faults, ANumberOutsideTheTableIsUnknownNotACrash) {
    EXPECT_EQ(find_fault(static_cast<FaultCode>(9999)), nullptr);
    EXPECT_EQ(name_of(static_cast<FaultCode>(9999)), "unknown");
    EXPECT_EQ(name_of(FaultCode::None), "none");
}

}  // namespace
}  // namespace lockstep
