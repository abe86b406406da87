#include "services/record/own_log.hpp"

#include <fmt/format.h>
#include <lockstep/record_loss_t.hpp>

#include "services/files/directories.hpp"
#include "services/record/queued_sink.hpp"
#include "services/record/rotating_log.hpp"
#include "services/wire/lcm/lcm_channels.hpp"
#include "services/wire/lcm/translate_lcm.hpp"

namespace lockstep {
namespace {

QueuedSink::WriteLoss loss_teller(const MachineSetup& machine, const std::string& axis) {
    return [machine = machine.name, axis](RecordSink& log, const RecordLoss& loss) {
        record_loss_t message{};
        message.utime = loss.last_utime;
        message.machine = machine;
        message.axis = axis;
        message.messages = static_cast<std::int64_t>(loss.messages);
        message.first_utime = loss.first_utime;
        log.publish(loss_channel(machine, axis), message);
        if (!loss.mark.empty()) { log.write(mark_channel(machine, axis), loss.last_utime, loss.mark); }
    };
}

}  // namespace

std::filesystem::path own_log_directory(const MachineSetup& machine) {
    return machine.record.directory.empty() ? record_directory(machine.name)
                                            : std::filesystem::path(machine.record.directory);
}

std::expected<std::unique_ptr<RecordSink>, std::string> open_own_log(const MachineSetup& machine,
                                                                     const std::string& axis) {
    constexpr std::uint64_t kBytesPerMB = 1'000'000;
    auto log =
        RotatingLog::open({.directory = own_log_directory(machine),
                           .name = axis.empty() ? "coordinator" : "axis-" + axis,
                           .limit_bytes = static_cast<std::uint64_t>(machine.record.size_limit_mb) * kBytesPerMB});
    if (!log) {
        return std::unexpected(
            log.error() +
            "; set record { directory } to a directory that can be written, or record { own_logs: false }");
    }
    return std::make_unique<QueuedSink>(std::make_unique<RotatingLog>(std::move(*log)), loss_teller(machine, axis),
                                        mark_channel(machine.name, axis));
}

std::string lost_records_text(const MachineSetup& machine, std::uint64_t lost) {
    const std::string failed = machine.record.own_logs ? fmt::format("written to {} (make room on its disk)",
                                                                     own_log_directory(machine).string())
                                                       : "sent (with record { own_logs: true } a disk keeps them)";
    return fmt::format(
        "{} messages of the record were lost since the start: they could not be {} or sent; lockstep log merge lists "
        "those that no log "
        "contains",
        lost, failed);
}

}  // namespace lockstep
