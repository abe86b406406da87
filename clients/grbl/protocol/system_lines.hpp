// A sender's lines that begin with $, except those that jog or reset: settings, parameters, homing, unlocking.
#pragma once

#include <string>
#include <string_view>

#include "clients/grbl/protocol/connection.hpp"

namespace lockstep::grbl {

class SystemLines {
public:
    /// `version`: Lockstep's version, for $I.
    SystemLines(Connection& connection, std::string version)
        : shared_(connection), next_machine_(connection.machine), version_(std::move(version)) {}

    /// Sets the configuration that the machine will have when it is next brought up, with the kept settings.
    void see_next(const MachineConfig& next) { next_machine_ = next; }
    /// `text`: behind the $.
    void do_line(std::string_view text);

private:
    void home(std::string_view axis);
    void unlock();
    void sleep();
    void restore(std::string_view what);
    void do_startup_block(std::string_view text);
    void write_setting(std::string_view text);
    void keep_setting(int number, double value);
    void print_settings();
    void print_parameters();
    void print_build();

    Connection& shared_;
    MachineConfig next_machine_;
    std::string version_;
};

}  // namespace lockstep::grbl
