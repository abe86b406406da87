// grbl's numbered settings: those of the machine are keys of its configuration, those of the reports belong to the
// connection.
#pragma once

#include <expected>
#include <string>
#include <vector>

#include "clients/grbl/protocol/errors.hpp"
#include "clients/grbl/protocol/status_report.hpp"
#include "core/machine.hpp"
#include "services/documents/edit/kept_settings.hpp"

namespace lockstep::grbl {

struct Setting {
    int number = 0;
    std::string value;
    std::string why_fixed;  // empty: it may be written
};

/// In the order of their numbers. Axes beyond the sixth have none.
std::vector<Setting> settings_of(const MachineConfig& machine, const ReportOptions& options);

/// $10 and $13 change `options`. Returns the keys of the machine's file that a written value changes; none, where it is
/// as it was. Whether the machine can have them is for the rules of its file.
std::expected<KeptSettings, Refused> write_setting(const MachineConfig& machine, int number, double value,
                                                   ReportOptions& options);

}  // namespace lockstep::grbl
