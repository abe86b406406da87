// Records that are merged, extracted, begun late or cut: parts of a valid record.
#include <stdexcept>

#include "clients/merge/log_merge.hpp"
#include "clients/merge/sessions.hpp"
#include "tests/records/kinds/kinds.hpp"
#include "tests/records/record_times.hpp"

namespace lockstep::records {
namespace {

/// Homing and three jobs with rests between them.
Record three_jobs() {
    MachineRun run(small_plotter());
    run.home();
    for (const char* gcode : {"G1 X30 Y20 F3000\nX5 Y5\n", "G1 X25 Y9 F3000\nG0 X5\n", "G1 X20 Y40 F3000\n"}) {
        run.run(gcode);
        run.wait_ms(1200);
    }
    return run.finish();
}

Record merged(const std::vector<std::filesystem::path>& logs, const merge::TimeSpan& span = {}) {
    MemorySink sink;
    const auto result = merge::merge_logs({.logs = logs, .span = span}, sink);
    if (!result) { throw std::runtime_error(result.error()); }
    return std::move(sink.record);
}

/// The logs of each process, as their boards keep them, with both halves in files that overlap.
std::vector<std::filesystem::path> own_logs(const Record& record, bool is_rotated) {
    std::vector<std::filesystem::path> logs;
    for (const std::string part : {"_X_", "_Y_", ""}) {
        Record own;
        for (const Message& message : record) {
            const bool is_of_axis =
                message.channel.find("_X_") != std::string::npos || message.channel.find("_Y_") != std::string::npos;
            if (part.empty() ? !is_of_axis : message.channel.find(part) != std::string::npos) {
                own.push_back(message);
            }
        }
        const auto size = static_cast<std::ptrdiff_t>(own.size());
        const Record first(own.begin(), own.begin() + size * 2 / 3);
        const Record second(own.begin() + size / 3, own.end());
        for (const Record& half : {first, second}) {
            if (is_rotated && &half == &first) { continue; }
            logs.push_back(record_folder() / ("own" + std::to_string(logs.size()) + ".lcm"));
            write_record(half, logs.back());
        }
    }
    return logs;
}

Record merged_own_logs() { return merged(own_logs(three_jobs(), false)); }

/// Two jobs with a laser and a valve.
Record laser_jobs() {
    MachineRun run(small_laser());
    run.home();
    for (int k = 0; k < 2; ++k) {
        run.run("G21 G90 F2400\nM4 S600\nG1 X30 Y8\nM62 P1\nX32 Y20\nS200\nM63 P1\nX5 Y5\nM5\n");
        run.wait_ms(1200);
    }
    return run.finish();
}

/// Two jobs with pulses at places. In the second one some are left.
Record camera_jobs() {
    MachineRun run(with_camera(small_plotter()));
    run.home();
    run.run("G21 G90 F2400\nM69 P0 Q8 R0.5 L41\nG1 X20 Y30\nM69 P0 Q28 R-1 L19\nX5 Y5\n");
    run.wait_ms(1200);
    run.begin("G21 G90 F2400\nM69 P0 Q8 R0.5 L41\nG1 X20 Y30\nM69 P0 Q28 R-1 L27\nX5 Y5\n");
    run.wait_ms(500);
    run.hold();
    run.resume();
    run.to_rest();
    run.wait_ms(300);
    return run.finish();
}

/// The first third of each process's log is gone.
Record merged_rotated_logs(const Record& record) {
    std::vector<std::filesystem::path> logs = own_logs(record, false);
    return merged({logs[1], logs[3], logs[5]});
}

Record extract(const Record& record, std::int64_t job) {
    const auto log = record_folder() / "session.lcm";
    write_record(record, log);
    const auto chosen = merge::choose_logs({{log}}, false);
    if (!chosen) { throw std::runtime_error(chosen.error()); }
    const auto span = merge::span_of_job(chosen->jobs, job);
    if (!span) { throw std::runtime_error("no job " + std::to_string(job)); }
    return merged({log}, *span);
}

/// An emergency stop between two other jobs.
Record stopped_between() {
    MachineRun run(small_plotter());
    run.home();
    run.run("G1 X30 Y20 F3000\nX5 Y5\n");
    run.begin("G1 X60 Y50 F3000\n");
    run.wait_ms(400);
    run.command(CommandKind::EmergencyStop);
    run.reach(MachinePhase::Fault);
    run.reset();
    run.home();
    run.run("G1 X20 Y40 F3000\n");
    return run.finish();
}

/// An emergency stop at rest, between two jobs.
Record stopped_at_rest() {
    MachineRun run(small_plotter());
    run.home();
    run.run("G1 X30 Y20 F3000\nX5 Y5\n");
    run.wait_ms(500);
    run.command(CommandKind::EmergencyStop);
    run.reach(MachinePhase::Fault);
    run.wait_ms(300);
    run.reset();
    run.home();
    run.run("G1 X20 Y40 F3000\n");
    return run.finish();
}

/// An axis's process ends at rest. The next one knows where the axis is, so it need not be homed.
Record restarted_with_position() {
    VirtualOptions options = options_of(small_plotter());
    options.keeps_positions = true;
    MachineRun run(options);
    run.home();
    run.run("G1 X30 Y20 F3000\n");
    run.wait_ms(500);
    run.restart(1, 300);
    run.wait_ms(3000);
    run.to_rest();
    run.run("G1 X20 Y40 F3000\nX5\n");
    return run.finish();
}

/// An axis's process ends at rest between two jobs.
Record restarted_between() {
    MachineRun run(small_plotter());
    run.home();
    run.run("G1 X30 Y20 F3000\nX5 Y5\n");
    run.wait_ms(500);
    run.restart(1, 300);
    run.wait_ms(2500);
    run.reset();
    run.home();
    run.run("G1 X20 Y40 F3000\n");
    return run.finish();
}

RecordKind begun_at(const std::string& name, std::function<std::int64_t(const Record&)> from,
                    const Expected& expected) {
    return {name,
            [from = std::move(from)] {
                Record record = three_jobs();
                const std::int64_t utime = from(record);
                std::erase_if(record, [&](const Message& message) { return message.utime < utime; });
                return record;
            },
            expected};
}

RecordKind ended_at(const std::string& name, std::function<std::int64_t(const Record&)> until,
                    const Expected& expected) {
    return {name,
            [until = std::move(until)] {
                Record record = three_jobs();
                const std::int64_t utime = until(record);
                std::erase_if(record, [&](const Message& message) { return message.utime >= utime; });
                return record;
            },
            expected};
}

std::int64_t newest_job(const Record& record) { return job_spans(record).back().job; }

}  // namespace

std::vector<RecordKind> file_of_log_kinds() {
    // Exact from the first whole job on; nothing is known of what came before.
    const Expected late{kSaysGood, kSaysGood | kSaysDoubtful | kSaysUnknown, kSaysGood | kSaysUnknown, kSaysGood, true};
    const Expected cut{kSaysGood | kSaysUnknown, kSaysDoubtful | kSaysUnknown, kSaysGood | kSaysUnknown,
                       kSaysGood | kSaysUnknown};
    const Expected extracted{kSaysGood, kSaysGood, kSaysGood | kSaysUnknown, kSaysGood};
    // The stop is no fault of the job beside it.
    const Expected with_a_stop{kSaysGood, kSaysGood | kSaysDoubtful, kSaysGood | kSaysUnknown, kSaysGood};
    std::vector<RecordKind> kinds{
        {"several_jobs", three_jobs},
        {"own_logs_merged", merged_own_logs},
        {"rotated_logs_merged", [] { return merged_rotated_logs(three_jobs()); }, late},
        {"laser_jobs", laser_jobs},
        {"camera_jobs", camera_jobs},
        {"own_logs_of_a_camera_merged", [] { return merged(own_logs(camera_jobs(), false)); }},
        {"own_logs_of_a_laser_merged", [] { return merged(own_logs(laser_jobs(), false)); }},
        {"rotated_logs_of_a_laser_merged", [] { return merged_rotated_logs(laser_jobs()); }, late},
        {"extract_of_a_laser_job", [] { return extract(laser_jobs(), 3); }, extracted},
        {"extract_of_the_first_job", [] { return extract(three_jobs(), 2); }, extracted},
        {"extract_of_the_second_job", [] { return extract(three_jobs(), 3); }, extracted},
        {"extract_of_the_last_job", [] { return extract(three_jobs(), 4); }, extracted},
        {"extract_before_an_emergency_stop", [] { return extract(stopped_between(), 2); }, extracted},
        {"extract_after_an_emergency_stop",
         [] {
             const Record record = stopped_between();
             return extract(record, newest_job(record));
         },
         extracted},
        {"extract_after_a_restart",
         [] {
             const Record record = restarted_between();
             return extract(record, newest_job(record));
         },
         extracted},
        {"extract_before_an_emergency_stop_at_rest", [] { return extract(stopped_at_rest(), 2); }, with_a_stop},
        {"extract_of_homing_after_an_emergency_stop", [] { return extract(stopped_at_rest(), 3); }, with_a_stop},
        {"extract_before_a_restart", [] { return extract(restarted_between(), 2); }, extracted},
        {"extract_of_homing_after_a_restart", [] { return extract(restarted_between(), 3); }, extracted},
        {"axis_restarted_that_knows_its_position", restarted_with_position},
        {"extract_after_a_restart_with_position", [] { return extract(restarted_with_position(), 3); }, extracted},
        begun_at(
            "begun_in_homing", [](const Record& r) { return job_spans(r).at(0).middle_us(); }, late),
        begun_at(
            "begun_in_a_job", [](const Record& r) { return job_spans(r).at(1).middle_us(); }, late),
        begun_at(
            "begun_between_jobs", [](const Record& r) { return job_spans(r).at(1).end_us + 500'000; }, late),
        begun_at("begun_in_the_last_job", [](const Record& r) { return job_spans(r).back().middle_us(); },
                 {kSaysGood | kSaysUnknown, kSaysDoubtful | kSaysUnknown, kSaysGood | kSaysUnknown,
                  kSaysGood | kSaysUnknown, true}),
        ended_at(
            "cut_in_homing", [](const Record& r) { return job_spans(r).at(0).middle_us(); }, cut),
        ended_at(
            "cut_in_a_job", [](const Record& r) { return job_spans(r).at(2).middle_us(); }, cut),
        ended_at("cut_between_jobs", [](const Record& r) { return job_spans(r).at(1).end_us + 700'000; },
                 {kSaysGood, kSaysGood | kSaysDoubtful | kSaysUnknown, kSaysGood | kSaysUnknown, kSaysGood}),
    };
    return kinds;
}

}  // namespace lockstep::records
