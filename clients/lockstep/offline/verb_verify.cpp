// lockstep verify
#include <memory>

#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/offline/result_text.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/text/output.hpp"
#include "clients/verification/verification.hpp"

namespace lockstep {
namespace {

struct VerifyOptions {
    std::string log;
    bool json = false;
};

ExitCode verify(const VerifyOptions& options) {
    Output output(options.json);
    const auto findings = verification::verify_log(options.log, output.percent_on_terminal("comparing"));
    if (!findings) { return output.fail(bad_input(findings.error())); }
    const bool exact = findings->is_exact();
    output.print(result_text(verification::to_text(*findings), exact));
    output.report(verification::to_report(*findings));
    return exact ? kExitDone : kExitFailed;
}

}  // namespace

void add_verify(Verb command) {
    const Verb verb = command.add_verb("verify", "compare every step in a log with its programs, tick for tick");
    const auto options = std::make_shared<VerifyOptions>();
    verb.add_option("log", options->log, "an LCM log, of lcm-logger or of lockstep simulate").required();
    add_json(verb, options->json);
    verb.footer(
        "Steps that a killed process made but did not record as runs are compared with all that the plan allows.\n"
        "Notes list what the log lacks. A log that begins late or ends early is compared as far as it goes; if it has\n"
        "too little, the result is unknown.\n" +
        footer("  lockstep verify plate.lcm\n  lockstep verify plate.lcm --json\n",
               "0 exact; 1 not exact or unknown: the report has the first difference, or what the log lacks;\n"
               "2 bad usage, or no log with steps, runs or jobs"));
    verb.action([options] { return verify(*options); });
}

}  // namespace lockstep
