#include "sim_fpga/firmware/rp2040/flash_id.hpp"

#include "sim_fpga/firmware/rp2040/chip.hpp"

namespace lockstep::firmware {

using namespace chip;

namespace {

constexpr std::uint32_t kReadUniqueId = 0x4B;  // a command of most makers: 4 bytes later, 8 bytes come
constexpr int kSilentBytes = 5;
constexpr int kAllBytes = kSilentBytes + 8;  // they fit into the queue, so that the flash stays selected
constexpr int kMostLooks = 100'000;

bool wait_for_byte() {
    for (int left = kMostLooks; left > 0; --left) {
        if ((at(flash_line::kStatus) & flash_line::kHasReceived) != 0) { return true; }
    }
    return false;
}

}  // namespace

std::uint64_t read_flash_id() {
    at(flash_line::kEnable) = 0;
    at(flash_line::kDivider) = 16;        // a byte takes 1 us
    at(flash_line::kControl) = 7U << 16;  // bytes, both ways
    at(flash_line::kEnable) = 1;
    for (int n = 0; n < kAllBytes; ++n) { at(flash_line::kData) = n == 0 ? kReadUniqueId : 0; }
    std::uint64_t id = 0;
    for (int n = 0; n < kAllBytes; ++n) {
        if (!wait_for_byte()) { return 0; }
        id = id << 8 | (at(flash_line::kData) & 0xFF);
    }
    return id == ~std::uint64_t{0} ? 0 : id;
}

}  // namespace lockstep::firmware
