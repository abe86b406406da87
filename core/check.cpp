#include "core/check.hpp"

#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace lockstep {
namespace {

void print_to_stderr(std::string_view promise, const std::source_location& where) {
    std::fprintf(stderr, "%s:%u: failed check: %.*s\n", where.file_name(), static_cast<unsigned>(where.line()),
                 static_cast<int>(promise.size()), promise.data());
}

std::atomic<CheckReporter> reporter_of_process = print_to_stderr;

}  // namespace

CheckReporter set_check_reporter(CheckReporter reporter) { return reporter_of_process.exchange(reporter); }

void fail_check(std::string_view promise, const std::source_location& where) {
    reporter_of_process.load()(promise, where);
    std::abort();
}

}  // namespace lockstep
