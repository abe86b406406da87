// The lockstep command as a user runs it: words in; exit code, standard output and standard error back.
#pragma once

#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>
#include <sys/types.h>

#include <string>
#include <vector>

namespace lockstep {

using Words = std::vector<std::string>;

struct Ran {
    int code = 0;  // minus the signal that ended it
    std::string out;
    std::string err;

    /// Standard output as a report; a failed expectation if it is none.
    template <typename Report>
    Report json() const {
        Report report;
        EXPECT_TRUE(google::protobuf::util::JsonStringToMessage(out, &report).ok()) << out << err;
        return report;
    }
};

/// A process that runs in parallel to the test; it ends with the object.
class ChildProcess {
public:
    /// program: a path. Its standard input is empty, and neither output is a terminal.
    explicit ChildProcess(const std::string& program, const Words& words);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    void signal(int number) const;
    /// Its standard output so far.
    std::string out() const;
    Ran wait();

private:
    pid_t pid_ = 0;
    std::string files_;  // the stem of its output files .out and .err
};

Ran run_lockstep(const Words& words);

}  // namespace lockstep
