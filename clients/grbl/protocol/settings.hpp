// grbl's numbered settings. Those of the machine are keys of its configuration. Those of the reports belong to the
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
    std::string why_fixed;  // empty if it may be written
};

/// In the order of their numbers. Only the first six axes have settings.
std::vector<Setting> settings_of(const MachineConfig& machine, const ReportOptions& options);

/// $10 and $13 change `options`. Returns the keys of the machine's file that the value changes; empty if it is the
/// same. Does not check the rules of the machine's file.
std::expected<KeptSettings, Refused> write_setting(const MachineConfig& machine, int number, double value,
                                                   ReportOptions& options);

}  // namespace lockstep::grbl
