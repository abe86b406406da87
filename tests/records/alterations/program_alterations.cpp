// Programs in the record that are not those that the machine ran.
#include <algorithm>

#include "services/documents/machine_file.hpp"
#include "services/documents/program_document.hpp"
#include "tests/records/alterations/alterations.hpp"
#include "tests/records/alterations/places.hpp"

namespace lockstep::records {
namespace {

constexpr Expected kProgramOtherPlan{kSaysBad, kSaysDoubtful | kSaysUnknown | kSaysBad, kSaysGood, kReplayedAlike};
constexpr Expected kProgramNoPlan{kSaysUnknown | kSaysRefused | kSaysBad, kSaysDoubtful | kSaysUnknown | kSaysBad,
                                  kSaysGood | kSaysUnknown, kReplayedAlike};

ProgramMove* last_move(Program& program) {
    ProgramMove* last = nullptr;
    for (Block& block : program.blocks) {
        auto* move = std::get_if<ProgramMove>(&block.action);
        if (move != nullptr && !move->rapid) { last = move; }
    }
    return last;
}

std::optional<std::size_t> begun_message(const Record& record) {
    const auto places = places_of<job_t>(
        record, [](const job_t& job) { return job.kind == "run" && job.event == "begun" && !job.program.empty(); });
    return places.empty() ? std::nullopt : std::optional(places.front());
}

bool change_program(Record& record, const std::function<void(Program&)>& change) {
    return change_at<job_t>(record, begun_message(record), [&](job_t& job) {
        Program program = program_from_text(job.program).value();
        change(program);
        job.program = program_text(program);
    });
}

struct ProgramChange {
    const char* name;
    void (*change)(Program&);
    Expected expected = kProgramOtherPlan;
};

const ProgramChange kProgramChanges[]{
    {"target_one_step_further", [](Program& program) { last_move(program)->target_mm[0] += 0.0125; }},
    {"target_far_away", [](Program& program) { last_move(program)->target_mm[0] += 3; }},
    {"feed_halved", [](Program& program) { last_move(program)->feed_mm_s /= 2; }},
    {"last_move_left_out", [](Program& program) { program.blocks.pop_back(); }},
    {"move_added", [](Program& program) { program.blocks.push_back(program.blocks.front()); }},
    {"dwell_added",
     [](Program& program) {
         program.blocks.insert(program.blocks.begin() + 1, Block{{}, Dwell{0.2}});
     }},
    {"pause_added",
     [](Program& program) {
         program.blocks.insert(program.blocks.begin() + 1, Block{{}, Pause{}});
     }},
    {"exact_stop_at_each_corner",
     [](Program& program) {
         for (Block& block : program.blocks) {
             if (auto* move = std::get_if<ProgramMove>(&block.action)) { move->mode = PathMode::ExactStop; }
         }
     }},
    {"start_elsewhere",
     [](Program& program) { program.start_mm[0] += 1; },
     {kSaysBad | kSaysUnknown, kSaysDoubtful | kSaysUnknown | kSaysBad, kSaysGood, kReplayedAlike}},
    {"axes_swapped", [](Program& program) { std::swap(program.axes[0], program.axes[1]); }},
};

bool change_config(Record& record, const std::function<void(MachineSetup&)>& change) {
    return change_each<job_t>(record, [&](job_t& job) {
               if (job.config.empty()) { return false; }
               MachineSetup machine = parse_machine(job.config).value();
               change(machine);
               job.config = machine_text(machine);
               return true;
           }) > 0;
}

void add_configurations(std::vector<Alteration>& all) {
    const auto with = [&](std::string name, std::function<void(MachineSetup&)> change, const Expected& expected) {
        all.push_back({"machine_" + std::move(name), [=](Record& r) { return change_config(r, change); }, expected});
    };
    with(
        "of_other_steps_per_mm",
        [](MachineSetup& machine) {
            machine.axes[0].steps_per_mm = 100;
            for (MotorBlock& motor : machine.axes[0].motors) { motor.steps_per_mm = 100; }
        },
        kProgramOtherPlan);
    with(
        "of_other_acceleration", [](MachineSetup& machine) { machine.axes[0].max_accel_mm_s2 = 700; },
        kProgramOtherPlan);
    with("of_other_slots", [](MachineSetup& machine) { machine.timing.slot_us = 5000; },
         {kSaysBad | kSaysRefused, kSaysDoubtful | kSaysUnknown | kSaysBad, kSaysGood, kReplayedAlike});
    with("with_a_further_axis",
         [](MachineSetup& machine) {
             machine.axes.push_back(machine.axes.front());
             machine.axes.back().name = "W";
             for (MotorBlock& motor : machine.axes.back().motors) { motor.name.front() = 'W'; }
         },
         {kSaysUnknown | kSaysBad | kSaysRefused, kSaysUnknown | kSaysBad, kSaysGood | kSaysUnknown, kReplayedAlike});
}

}  // namespace

std::vector<Alteration> program_alterations() {
    std::vector<Alteration> all;
    for (const ProgramChange& change : kProgramChanges) {
        all.push_back({"program_" + std::string(change.name),
                       [=](Record& r) { return change_program(r, change.change); }, change.expected, Altered{},
                       Needs{.whole_program = true}});
    }
    const auto text = [&](std::string name, const std::string& program) {
        all.push_back({std::move(name),
                       [=](Record& r) {
                           return change_at<job_t>(r, begun_message(r), [&](job_t& job) { job.program = program; });
                       },
                       kProgramNoPlan, Altered{}, Needs{.whole_program = true}});
    };
    text("program_empty", "");
    text("program_unreadable", "blocks { nonsense: 1 }");
    const auto parts = [&](std::string name, std::function<bool(Record&)> alter, const Expected& expected) {
        all.push_back({std::move(name), std::move(alter), expected, Altered{}, Needs{.parts = true}});
    };
    const Expected lost{kSaysUnknown, kSaysDoubtful | kSaysUnknown, kSaysUnknown, kReplayedAlike};
    const auto place = [](const Record& r) {
        return places_of<program_part_t>(r, [](const auto& part) { return part.size > 0; })[1];
    };
    parts(
        "program_part_dropped", [=](Record& r) { return erase_at(r, place(r)); }, lost);
    parts("program_part_unreadable",
          [=](Record& r) {
              return change_at<program_part_t>(
                  r, place(r), [](program_part_t& part) { std::fill_n(part.data.begin(), 8, std::uint8_t{0xff}); });
          },
          {kSaysUnknown | kSaysBad | kSaysRefused, kSaysDoubtful | kSaysUnknown | kSaysBad, kSaysGood | kSaysUnknown,
           kReplayedAlike});
    parts("program_part_twice", [=](Record& r) { return repeat_at(r, place(r)); },
          {kSaysGood, kSaysGood, kSaysGood, kReplayedAlike});
    add_configurations(all);
    all.push_back({"machine_unreadable",
                   [](Record& r) {
                       return change_each<job_t>(r, [](job_t& job) {
                                  const bool is_there = !job.config.empty();
                                  if (is_there) { job.config = "name: nothing {"; }
                                  return is_there;
                              }) > 0;
                   },
                   kProgramNoPlan});
    return all;
}

}  // namespace lockstep::records
