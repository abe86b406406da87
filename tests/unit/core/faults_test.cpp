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

TEST(Faults, ARemedyIsInTheWordsOfTheClient) {
    const FaultText& fault = *find_fault(FaultCode::FramesDiffer);
    const RemedyWords loud = [](Remedy remedy) { return "<" + std::string(name_of(remedy)) + ">"; };
    EXPECT_EQ(
        remedy_text(fault, loud),
        "find the axis: <incident>; then check its network, or use longer slots: <timing>; then: <reset>, <home>");
    EXPECT_EQ(remedy_text(*find_fault(FaultCode::Busy), loud), "<wait>, or: <stop>");
    EXPECT_EQ(remedy_text(*find_fault(FaultCode::LimitHit), words_to_fill_in),
              "find out why the axis reached the switch; then: {reset}, {home}");
}

TEST(Faults, OfABoardAreNotRemediedByHomingWhichABoardCannot) {
    EXPECT_EQ(remedy_text(for_board(*find_fault(FaultCode::AxisLost)), words_to_fill_in),
              "see the axis's log, and start its lockstep-axis if it is not running; then: {reset}");
    EXPECT_EQ(remedy_text(for_board(*find_fault(FaultCode::EmergencyStopInput)), words_to_fill_in),
              remedy_text(*find_fault(FaultCode::EmergencyStopInput), words_to_fill_in))
        << "axes may have been stopped in motion";
    EXPECT_EQ(remedy_text(for_board(*find_fault(FaultCode::Busy))), remedy_text(*find_fault(FaultCode::Busy)));
}

TEST(Faults, ATextForTheUsersOfEveryClientNamesNoCommandOfTheShell) {
    for (int number = 100; number < 200; ++number) {
        const FaultText* text = find_fault(static_cast<FaultCode>(number));
        if (text == nullptr) { continue; }
        const std::string plain = remedy_text(*text);
        EXPECT_EQ(plain.find("lockstep "), std::string::npos) << plain;
        EXPECT_EQ(plain.find("--"), std::string::npos) << plain;
        EXPECT_EQ(plain.find('{'), std::string::npos) << plain;
    }
}

TEST(Faults, ANumberOutsideTheTableIsUnknownNotACrash) {
    EXPECT_EQ(find_fault(static_cast<FaultCode>(9999)), nullptr);
    EXPECT_EQ(name_of(static_cast<FaultCode>(9999)), "unknown");
    EXPECT_EQ(name_of(FaultCode::None), "none");
}

}  // namespace
}  // namespace lockstep
