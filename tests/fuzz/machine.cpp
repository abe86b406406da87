// Parses any bytes as a machine's file. The result is errors with line and column, or a machine that keeps all rules
// and is the same after it is written and read.
#include <cstdint>
#include <string>

#include "services/documents/machine_file.hpp"
#include "services/documents/machine_rules.hpp"
#include "tests/fuzz/require.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace lockstep;
    const auto machine = parse_machine(std::string(reinterpret_cast<const char*>(data), size));
    if (!machine) {
        require(!machine.error().empty(), "a refusal has an error");
        for (const Diagnostic& error : machine.error()) {
            require(error.line >= 1 && error.column >= 1 && !error.message.empty(), "an error has a place and a text");
        }
        return 0;
    }
    require(machine_problems(*machine).empty(), "a machine that is read keeps all rules");
    const auto again = parse_machine(machine_text(*machine));
    require(again.has_value(), "a machine that is written can be read");
    require(config_hash(*again) == config_hash(*machine), "a machine that is written is the same machine");
    return 0;
}
