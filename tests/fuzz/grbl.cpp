// A sender writes any bytes to grbl's protocol while the machine changes its state. Every line has its end, the output
// is bounded, requests are within the machine's bounds, and after a reset a line is answered.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "clients/grbl/protocol/grbl.hpp"
#include "tests/fuzz/require.hpp"
#include "tests/unit/grbl/mill.hpp"

namespace lockstep::grbl {
namespace {

class Bench {
public:
    Bench() {
        view_.is_received = true;
        view_.phase = MachinePhase::Idle;
        view_.axes = {{10, true}, {20, true}, {30, true}};
        grbl_.see(view_);
    }

    /// The first byte selects the action. Returns the number of bytes used.
    std::size_t take(std::string_view bytes) {
        const auto what = static_cast<unsigned char>(bytes[0]);
        const std::size_t length = std::min<std::size_t>(bytes.size() - 1, what / 8);
        switch (what % 8) {
            case 5: grbl_.answer(asked_, {.is_done = what > 128}); break;
            case 6: change(what / 8); break;
            case 7: what > 128 ? grbl_.abort("lost") : grbl_.end_jog(); break;
            default: grbl_.receive(bytes.substr(1, length)); break;
        }
        check_output();
        check_requests();
        return what % 8 < 5 ? length + 1 : 1;
    }

    void finish() {
        change(static_cast<unsigned>(MachinePhase::Idle));
        grbl_.end_jog();
        grbl_.receive("\x18");
        (void)grbl_.take_output();
        grbl_.receive("\n$I\n");
        const std::string answer = grbl_.take_output();
        require(answer.starts_with("ok\r\n") && answer.ends_with("\r\nok\r\n"), "a reset makes it as at the beginning");
    }

private:
    void change(unsigned what) {
        view_.phase = static_cast<MachinePhase>(what % 10);
        view_.fault = view_.phase == MachinePhase::Fault ? FaultCode::DeviceLost : FaultCode::None;
        view_.axes[0] = {static_cast<double>(what), what % 3 != 0, what % 2 == 0};
        view_.lines = view_.phase == MachinePhase::Running ? what : 0;
        view_.is_stopping = false;
        grbl_.see(view_);
    }
    void check_output() {
        const std::string output = grbl_.take_output();
        require(output.empty() || output.ends_with("\r\n"), "every line has its end");
        require(output.size() < 1'000'000, "an answer is bounded");
    }
    void check_requests() {
        for (const Request& request : grbl_.take_requests()) {
            asked_ = request.number;
            require(request.overrides.feed_percent >= Overrides::kLeast &&
                        request.overrides.feed_percent <= Overrides::kMost,
                    "an override is in its range");
            for (const JogAxis& jog : request.jogs) {
                require(jog.axis < 3 && std::abs(jog.speed_mm_s) <= 50, "a jog is of an axis, within its speed");
            }
            for (const double mm : request.line.from_mm) { require(std::isfinite(mm), "a place is a number"); }
            for (const KeptSetting& setting : request.settings) {
                require(settings_from_text(settings_text({setting})) == KeptSettings{setting},
                        "a setting is written as it is read");
            }
        }
    }

    MachineView view_;
    Grbl grbl_{mill(), "1"};
    std::uint64_t asked_ = 0;
};

}  // namespace
}  // namespace lockstep::grbl

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string_view bytes(reinterpret_cast<const char*>(data), size);
    lockstep::grbl::Bench bench;
    while (!bytes.empty()) { bytes.remove_prefix(bench.take(bytes)); }
    bench.finish();
    return 0;
}
