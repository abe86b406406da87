// Alterations of valid records, as data: what is changed, and what the tools must say afterwards.
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "tests/records/expected.hpp"
#include "tests/records/record.hpp"

namespace lockstep::records {

/// What a base record must contain so that the alteration is possible. Every base has homing, a program and an own
/// move.
struct Needs {
    bool events = false;     // of the program
    bool overrides = false;  // and holds
    bool clocks = false;     // of each board
    bool parts = false;      // of a program that is sent in parts
    bool restart = false;    // of an axis's process
    bool shared_clock = false;  // one clock drives all devices
    bool whole_program = false;  // in the job's own message
};

struct Alteration {
    std::string name;
    /// Returns false if the record has no place for it.
    std::function<bool(Record&)> alter;
    Expected expected;
    Altered altered{.motion = true};
    Needs needs;

    /// For GoogleTest.
    friend void PrintTo(const Alteration& alteration, std::ostream* out) { *out << alteration.name; }
};

std::vector<Alteration> step_alterations();      // one step, or one message of steps
std::vector<Alteration> inserted_steps();        // further messages of steps with their own numbers
std::vector<Alteration> run_alterations();
std::vector<Alteration> job_alterations();
std::vector<Alteration> program_alterations();
std::vector<Alteration> event_alterations();
std::vector<Alteration> mark_alterations();
std::vector<Alteration> sample_alterations();    // positions and health
std::vector<Alteration> order_alterations();
std::vector<Alteration> machine_alterations();   // other machines, configurations and versions
/// All of them.
const std::vector<Alteration>& alterations();

/// A damaged log file, made from the bytes of a valid one.
struct FileAlteration {
    std::string name;
    std::function<void(std::string& bytes)> alter;
    Expected expected;

    /// For GoogleTest.
    friend void PrintTo(const FileAlteration& alteration, std::ostream* out) { *out << alteration.name; }
};
const std::vector<FileAlteration>& file_alterations();

/// Valid records that are altered.
struct Base {
    std::string name;
    std::function<Record()> make;
    Needs has;

    bool fulfils(const Needs& needs) const;
    /// For GoogleTest.
    friend void PrintTo(const Base& base, std::ostream* out) { *out << base.name; }
};
const std::vector<Base>& bases();

}  // namespace lockstep::records
