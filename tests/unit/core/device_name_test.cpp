#include "core/device/device_name.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

TEST(DeviceName, ANameThatIsReadIsWrittenAsItWas) {
    for (const char* text : {"sim", "shm:lockstep-mill-X", "uio:/dev/uio0"}) {
        const auto device = read_device_name(text);
        ASSERT_TRUE(device) << text;
        EXPECT_EQ(device->text(), text);
    }
}

TEST(DeviceName, OnlyHardwareHasAClockOfItsOwn) {
    EXPECT_FALSE(read_device_name("sim")->has_own_clock());
    EXPECT_FALSE(read_device_name("shm:m-X")->has_own_clock());
    EXPECT_TRUE(read_device_name("uio:/dev/uio0")->has_own_clock());
}

TEST(DeviceName, RefusesNamesWithoutAPlaceOrOfAnotherKind) {
    for (const char* text : {"", "s", "usb", "sim:", "shm:", "shm:a/b", "uio:", "uio:/", "uio:uio0", "SIM"}) {
        EXPECT_FALSE(read_device_name(text)) << text;
    }
}

}  // namespace
}  // namespace lockstep
