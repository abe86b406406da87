#include <fmt/format.h>

#include <algorithm>

#include "services/documents/machine_rules.hpp"
#include "services/documents/problem_list.hpp"

namespace lockstep {
namespace {

constexpr double kMostPlace_mm = 1e6;

class WorkpieceRules {
public:
    explicit WorkpieceRules(const MachineConfig& machine) : machine_(machine), work_(*machine.workpiece) {}

    std::vector<Problem> check() {
        for (const char* name : {"X", "Y", "Z"}) {
            problems_.require(std::ranges::count(names_, name) == 1, "workpiece",
                              fmt::format("workpiece is given, but the machine has no axis {}; a workpiece needs axes "
                                          "X, Y and Z: remove it, or rename the axes",
                                          name));
        }
        problems_.require_range("workpiece.tip_mm", work_.tip_mm, 0, 50);
        problems_.require_range("workpiece.tip_length_mm", work_.tip_length_mm, 0, 1000);
        for (std::size_t k = 0; k < work_.blocks.size(); ++k) {
            check(work_.blocks[k], fmt::format("workpiece.block[{}].", k));
        }
        for (std::size_t k = 0; k < work_.posts.size(); ++k) {
            check(work_.posts[k], fmt::format("workpiece.post[{}].", k));
        }
        return problems_.take();
    }

private:
    void check_place(const std::string& key, double mm) {
        problems_.require_range(key, mm, -kMostPlace_mm, kMostPlace_mm);
    }
    void check_order(const std::string& at, const char* axis, double min, double max) {
        check_place(fmt::format("{}{}_min_mm", at, axis), min);
        const std::string key = fmt::format("{}{}_max_mm", at, axis);
        check_place(key, max);
        problems_.require(
            min < max, key,
            fmt::format("{} is {}; it must be above {}_min_mm, {}", key, number_text(max), axis, number_text(min)));
    }
    void check_round(const std::string& at, const auto& round) {
        check_place(at + "x_mm", round.x_mm);
        check_place(at + "y_mm", round.y_mm);
        problems_.require_range(at + "diameter_mm", round.diameter_mm, 0.001, 1e5);
    }
    void check_probe(const std::string& key, int number) {
        const auto closes = [&](const InputConfig& input) {
            return input.use == InputUse::Probe && input.number == number;
        };
        problems_.require(std::ranges::any_of(machine_.inputs, closes), key,
                          fmt::format("{} is {}, but no input with use: PROBE has this number; add one, or choose "
                                      "another number",
                                      key, number));
    }
    void check(const WorkBlock& block, const std::string& at) {
        check_order(at, "x", block.x_min_mm, block.x_max_mm);
        check_order(at, "y", block.y_min_mm, block.y_max_mm);
        check_place(at + "top_mm", block.top_mm);
        problems_.require_range(at + "rise_x", block.rise_x, -0.5, 0.5);
        problems_.require_range(at + "rise_y", block.rise_y, -0.5, 0.5);
        problems_.require_range(at + "angle_deg", block.angle_deg, -180, 180);
        problems_.require_range(at + "wave_mm", block.wave_mm, 0, 100);
        problems_.require_range(at + "wave_length_mm", block.wave_length_mm, 1, 1e5);
        problems_.require_between({at + "wave_mm", at + "wave_length_mm"}, block.wave_mm <= block.wave_length_mm / 20,
                                  fmt::format("{}wave_mm is {}; it must be at most a 20th of wave_length_mm, {}", at,
                                              number_text(block.wave_mm), number_text(block.wave_length_mm / 20)));
        for (std::size_t k = 0; k < block.bores.size(); ++k) {
            check_round(fmt::format("{}bore[{}].", at, k), block.bores[k]);
        }
        check_probe(at + "probe", block.probe);
    }
    void check(const WorkPost& post, const std::string& at) {
        check_round(at, post);
        check_place(at + "top_mm", post.top_mm);
        check_probe(at + "probe", post.probe);
    }

    const MachineConfig& machine_;
    const WorkpieceConfig& work_;
    std::vector<std::string> names_ = machine_.axis_names();
    ProblemList problems_;
};

}  // namespace

std::vector<Problem> workpiece_problems(const MachineConfig& machine) {
    return machine.workpiece ? WorkpieceRules(machine).check() : std::vector<Problem>{};
}

}  // namespace lockstep
