// Alterations of valid records, as data: what is changed, and what the tools must say afterwards.
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "tests/records/expected.hpp"
#include "tests/records/record.hpp"

namespace lockstep::records {

/// The contents of a base record that make the alteration possible. Every base has homing, a program and an own
/// move.
struct Needs {
    bool events = false;         // of the program
    bool outputs = false;        // that the program switches
    bool overrides = false;      // and holds
    bool clocks = false;         // of each board
    bool parts = false;          // of a program that is sent in parts
    bool restart = false;        // of an axis's process
    bool shared_clock = false;   // one clock drives all devices
    bool whole_program = false;  // in the job's own message
    bool all_motions = false;    // homing and own moves are altered in these bases only, to save time
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

std::vector<Alteration> step_alterations();  // one step, or one message of steps
std::vector<Alteration> inserted_steps();    // further messages of steps with their own numbers
std::vector<Alteration> run_alterations();
std::vector<Alteration> job_alterations();
std::vector<Alteration> program_alterations();
std::vector<Alteration> event_alterations();
std::vector<Alteration> output_alterations();
std::vector<Alteration> mark_alterations();
std::vector<Alteration> sample_alterations();  // positions and health
std::vector<Alteration> order_alterations();
std::vector<Alteration> machine_alterations();  // other machines, configurations and versions
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
/// The base's record, made once.
const Record& record_of(const Base& base);

/// A base and an alteration that it has a place for.
struct AlteredBase {
    Base base;
    Alteration alteration;

    std::string name() const { return base.name + "__" + alteration.name; }
    /// For GoogleTest.
    friend void PrintTo(const AlteredBase& altered, std::ostream* out) { *out << altered.name(); }
};
std::vector<AlteredBase> altered_bases();
/// The tools' verdicts about the first base's file with this damage.
Judgement judge_damaged(const FileAlteration& damage);

}  // namespace lockstep::records
