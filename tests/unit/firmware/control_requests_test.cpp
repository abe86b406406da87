// What a USB host may ask of the board, and what it gets.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "sim_fpga/firmware/usb/control_requests.hpp"

namespace lockstep::testing {
namespace {

using firmware::usb::ControlRequests;
using firmware::usb::Reply;
using firmware::usb::SetupPacket;

constexpr std::uint64_t kSerial = 0x0E61'3852'834C'1B2F;

std::vector<std::uint8_t> bytes_of(const Reply& reply) { return {reply.data.at, reply.data.at + reply.data.size}; }

SetupPacket descriptor(unsigned kind, unsigned number, std::uint16_t length) {
    return {0x80, 6, static_cast<std::uint16_t>(kind << 8 | number), 0, length};
}
constexpr SetupPacket kConfigure{0, 9, 1, 0, 0};
constexpr SetupPacket kOpen{0x21, 0x22, 3, 0, 0};
constexpr SetupPacket kClose{0x21, 0x22, 0, 0, 0};
constexpr SetupPacket kSetCoding{0x21, 0x20, 0, 0, 7};
constexpr std::array<std::uint8_t, 7> kCoding1200{0xB0, 0x04, 0, 0, 0, 0, 8};

std::string text(const ControlRequests& requests, unsigned number) {
    auto copy = requests;
    const auto bytes = bytes_of(copy.take(descriptor(3, number, 255)));
    std::string text;
    for (std::size_t n = 2; n + 1 < bytes.size(); n += 2) { text += static_cast<char>(bytes[n]); }
    return text;
}

TEST(ControlRequests, SendNotMoreThanTheHostAsksFor) {
    ControlRequests requests(kSerial);
    EXPECT_EQ(bytes_of(requests.take(descriptor(1, 0, 64))).size(), 18U);
    EXPECT_EQ(bytes_of(requests.take(descriptor(1, 0, 8))).size(), 8U);
    EXPECT_EQ(bytes_of(requests.take(descriptor(2, 0, 9))).size(), 9U);
    EXPECT_EQ(bytes_of(requests.take(descriptor(2, 0, 255))).size(), 67U);
}

TEST(ControlRequests, NameTheBoardAndItsFlash) {
    const ControlRequests requests(kSerial);
    EXPECT_EQ(text(requests, 1), "Lockstep");
    EXPECT_EQ(text(requests, 2), "Motor board");
    EXPECT_EQ(text(requests, 3), "0E613852834C1B2F");
}

TEST(ControlRequests, RefuseWhatTheBoardDoesNotHave) {
    ControlRequests requests(kSerial);
    for (const SetupPacket& setup :
         {descriptor(6, 0, 10), descriptor(3, 4, 255), descriptor(1, 1, 18), SetupPacket{0, 9, 2, 0, 0},
          SetupPacket{0x40, 1, 0, 0, 0}, SetupPacket{0x21, 0x23, 10, 0, 0}, SetupPacket{0x21, 0x20, 0, 0, 6},
          SetupPacket{0, 3, 1, 0, 0}, SetupPacket{1, 11, 1, 1, 0}, SetupPacket{0, 6, 0x100, 0, 18}}) {
        EXPECT_EQ(requests.take(setup).kind, Reply::Kind::Refused)
            << int{setup.type} << " " << int{setup.request} << " " << setup.value;
    }
}

TEST(ControlRequests, GiveTheLineToAHostThatOpensIt) {
    ControlRequests requests(kSerial);
    EXPECT_EQ(requests.take(kOpen).kind, Reply::Kind::Done);
    EXPECT_FALSE(requests.is_open()) << "it is not configured";
    EXPECT_EQ(requests.take(kConfigure).restarts, firmware::usb::kRestartsIn | firmware::usb::kRestartsOut);
    EXPECT_FALSE(requests.is_open());
    EXPECT_EQ(requests.take(kOpen).kind, Reply::Kind::Done);
    EXPECT_TRUE(requests.is_open());
    EXPECT_EQ(requests.take(kClose).kind, Reply::Kind::Done);
    EXPECT_FALSE(requests.is_open());
}

TEST(ControlRequests, ForgetTheHostAtAResetOfTheBus) {
    ControlRequests requests(kSerial);
    EXPECT_EQ(requests.take({0, 5, 19, 0, 0}).kind, Reply::Kind::Done);
    EXPECT_EQ(requests.take(kConfigure).kind, Reply::Kind::Done);
    EXPECT_EQ(requests.take(kOpen).kind, Reply::Kind::Done);
    EXPECT_EQ(requests.address(), 19);
    requests.reset();
    EXPECT_EQ(requests.address(), 0);
    EXPECT_FALSE(requests.is_configured());
    EXPECT_EQ(requests.take(kConfigure).kind, Reply::Kind::Done);
    EXPECT_FALSE(requests.is_open());
}

TEST(ControlRequests, BeginTheCountOfPacketsAgainWhereTheHostDoes) {
    ControlRequests requests(kSerial);
    EXPECT_EQ(requests.take({2, 1, 0, 0x82, 0}).restarts, firmware::usb::kRestartsIn);
    EXPECT_EQ(requests.take({2, 1, 0, 0x02, 0}).restarts, firmware::usb::kRestartsOut);
    EXPECT_EQ(requests.take({2, 1, 0, 0x81, 0}).restarts, 0U);
    EXPECT_EQ(requests.take({1, 11, 0, 0, 0}).restarts, 0U);
    EXPECT_EQ(requests.take({1, 11, 0, 1, 0}).restarts, firmware::usb::kRestartsIn | firmware::usb::kRestartsOut);
}

TEST(ControlRequests, KeepTheSpeedThatTheHostSets) {
    ControlRequests requests(kSerial);
    EXPECT_EQ(requests.speed(), 1'000'000U);
    EXPECT_EQ(requests.take(kSetCoding).kind, Reply::Kind::AwaitsData);
    EXPECT_EQ(requests.take_data(kCoding1200.data(), 6).kind, Reply::Kind::Refused);
    EXPECT_EQ(requests.take_data(kCoding1200.data(), 7).kind, Reply::Kind::Done);
    EXPECT_EQ(requests.speed(), 1200U);
    EXPECT_EQ(bytes_of(requests.take({0xA1, 0x21, 0, 0, 7})),
              std::vector<std::uint8_t>(kCoding1200.begin(), kCoding1200.end()));
}

TEST(ControlRequests, AskForTheBootModeOnceIfTheLineIsClosedAt1200Baud) {
    ControlRequests requests(kSerial);
    requests.take(kConfigure);
    requests.take(kOpen);
    requests.take(kClose);
    EXPECT_FALSE(requests.takes_boot_request()) << "at 1 MBd";
    requests.take_data(kCoding1200.data(), 7);
    requests.take(kClose);
    EXPECT_FALSE(requests.takes_boot_request()) << "it was not open";
    requests.take(kOpen);
    requests.take(kClose);
    EXPECT_TRUE(requests.takes_boot_request());
    EXPECT_FALSE(requests.takes_boot_request());
}

}  // namespace
}  // namespace lockstep::testing
