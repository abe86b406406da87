#include "core/device/device_name.hpp"

#include <gtest/gtest.h>

#include "core/device/link_name.hpp"

namespace lockstep {
namespace {

TEST(DeviceName, ANameThatIsReadIsWrittenAsItWas) {
    for (const char* text : {"sim", "shm:lockstep-mill-X", "uio:/dev/uio0", "board:pico1/0", "board:pico1/15"}) {
        const auto device = read_device_name(text);
        ASSERT_TRUE(device) << text;
        EXPECT_EQ(device->text(), text);
    }
}

TEST(DeviceName, ADeviceBehindALinkHasABoardAndANumber) {
    EXPECT_EQ(read_device_name("board:pico1/2"), (DeviceName{DeviceName::Kind::Linked, "pico1", 2}));
}

TEST(DeviceName, OnlyHardwareHasAClockOfItsOwn) {
    EXPECT_FALSE(read_device_name("sim")->has_own_clock());
    EXPECT_FALSE(read_device_name("shm:m-X")->has_own_clock());
    EXPECT_TRUE(read_device_name("uio:/dev/uio0")->has_own_clock());
    EXPECT_TRUE(read_device_name("board:pico1/0")->has_own_clock());
}

TEST(DeviceName, RefusesNamesWithoutAPlaceOrOfAnotherKind) {
    for (const char* text :
         {"", "s", "usb", "sim:", "shm:", "shm:a/b", "uio:", "uio:/", "uio:uio0", "SIM", "board:", "board:/0",
          "board:pico1", "board:pico1/", "board:pico1/x", "board:pico1/01", "board:pico1/16", "board:pico1/-1"}) {
        EXPECT_FALSE(read_device_name(text)) << text;
    }
}

TEST(LinkName, IsASerialLineAnSpiOrATcpConnection) {
    EXPECT_EQ(read_link_name("serial:/dev/ttyUSB0"), (LinkName{LinkName::Kind::Serial, "/dev/ttyUSB0"}));
    EXPECT_EQ(read_link_name("tcp:127.0.0.1:7001"), (LinkName{LinkName::Kind::Tcp, "127.0.0.1", 7001}));
    EXPECT_EQ(read_link_name("spi:/dev/spidev0.0"), (LinkName{LinkName::Kind::Spi, "/dev/spidev0.0", 0, 5'000'000}));
    EXPECT_EQ(read_link_name("spi:/dev/spidev1.2@250000"),
              (LinkName{LinkName::Kind::Spi, "/dev/spidev1.2", 0, 250'000}));
}

TEST(LinkName, IsWrittenAsItWasRead) {
    for (const char* text :
         {"serial:/dev/ttyUSB0", "tcp:127.0.0.1:7001", "spi:/dev/spidev0.0", "spi:/dev/spidev0.0@1000000"}) {
        EXPECT_EQ(read_link_name(text).value().text(), text);
    }
}

TEST(LinkName, RefusesOthers) {
    for (const char* text :
         {"", "/dev/ttyUSB0", "serial:", "serial:ttyUSB0", "serial:/", "usb:1", "tcp:", "tcp:host:1", "tcp:127.0.0.1",
          "tcp:127.0.0.1:0", "tcp:127.0.0.1:70000", "tcp::7001", "spi:", "spi:spidev0.0", "spi:/dev/spidev0.0@",
          "spi:/dev/spidev0.0@0", "spi:/dev/spidev0.0@1MHz", "spi:/dev/spidev0.0@5000000000"}) {
        EXPECT_FALSE(read_link_name(text)) << text;
    }
}

}  // namespace
}  // namespace lockstep
