#include "clients/supervisor/page.hpp"

#include <algorithm>
#include <thread>

#include "clients/supervisor/service_lines.hpp"
#include "services/files/text_file.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

bool is_given_up(const StateDirectory& state) {
    const auto processes = state.recorded();
    const auto web = std::ranges::find(processes, kWeb, &ProcessRecord::name);
    return web != processes.end() && !web->pid;
}

}  // namespace

std::expected<std::string, std::string> await_page(const StateDirectory& state, std::chrono::nanoseconds patience) {
    constexpr std::size_t kTailLines = 6;
    const auto deadline = monotonic_now() + patience;
    for (;;) {
        if (auto page = read_text_file(state.page_file())) { return *std::move(page); }
        if (is_given_up(state) || monotonic_now() > deadline) {
            return std::unexpected("the page is not served; the end of its log " + state.log_file(kWeb).string() +
                                   ":\n" + tail_of(state.log_file(kWeb), kTailLines));
        }
        std::this_thread::sleep_for(50ms);
    }
}

}  // namespace lockstep
