// lockstep-planner-times: the times of jobs as Lockstep, Klipper and grbl plan them. The script `compare` makes the
// jobs and calls it.
#include <algorithm>
#include <iostream>
#include <iterator>

#include "services/arguments/argument_parser.hpp"
#include "services/documents/machine_file.hpp"
#include "services/files/text_file.hpp"
#include "tests/benchmarks/planners/document_block.hpp"
#include "tests/benchmarks/planners/table.hpp"

namespace lockstep::planners {
namespace {

struct Options {
    std::string machine;
    std::string jobs;
    std::string document;
    bool writes = false;
    bool measures_cost = false;
};

using Done = std::expected<void, std::string>;

std::expected<std::vector<NamedProgram>, std::string> programs_of(const Options& options, const MachineSetup& machine) {
    std::vector<NamedProgram> all = simple_paths();
    auto jobs = jobs_of(options.jobs, machine);
    if (!jobs) { return std::unexpected(jobs.error()); }
    std::ranges::move(*jobs, std::back_inserter(all));
    return all;
}

/// Writes the tables into the document, or compares them with those in it.
Done document(const Options& options, const std::string& tables) {
    const auto text = read_text_file(options.document);
    if (!text) { return std::unexpected(text.error().message); }
    const auto changed = with_block(*text, tables);
    if (!changed) { return std::unexpected(changed.error()); }
    if (options.writes) { return write_text_file(options.document, *changed); }
    const std::string difference = first_difference(block_of(*text).value(), tables);
    if (difference.empty()) { return {}; }
    return std::unexpected(difference + "\ntests/benchmarks/planners/compare BUILD --write writes the table again");
}

Done run(const Options& options) {
    const auto machine = load_machine_file(options.machine);
    if (!machine) { return std::unexpected("the machine's file has errors"); }
    const auto programs = programs_of(options, *machine);
    if (!programs) { return std::unexpected(programs.error()); }
    if (options.measures_cost) {
        const auto costs = costs_text(*machine, *programs);
        if (!costs) { return std::unexpected(costs.error()); }
        std::cout << *costs;
        return {};
    }
    std::vector<Row> rows;
    for (const NamedProgram& named : *programs) {
        auto row = compare(*machine, named);
        if (!row) { return std::unexpected(row.error()); }
        if (std::ranges::max(row->lockstep.changes) > 1.005) {
            return std::unexpected(row->name + ": Lockstep changes an axis's speed by more than its limits allow");
        }
        rows.push_back(*std::move(row));
    }
    const std::string tables = tables_text(rows, limits_of(*machine));
    std::cout << tables;
    return options.document.empty() ? Done{} : document(options, tables);
}

}  // namespace
}  // namespace lockstep::planners

int main(int argc, char** argv) {
    lockstep::ArgumentParser parser("Times of jobs as Lockstep, Klipper and grbl plan them");
    lockstep::planners::Options options;
    parser.add_option("--machine", options.machine, "its configuration file").required();
    parser.add_option("--jobs", options.jobs, "the folder with the job set").required();
    parser.add_option("--document", options.document, "compare the tables with those in this document");
    parser.add_flag("--write", options.writes, "write them there instead");
    parser.add_flag("--cost", options.measures_cost, "print how long planning takes instead");
    parser.action([&] {
        const auto done = lockstep::planners::run(options);
        if (!done) { std::cerr << "lockstep-planner-times: " << done.error() << "\n"; }
        return done ? 0 : 1;
    });
    return parser.run(argc, argv);
}
