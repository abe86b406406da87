// The sinks: LCM's network (for lcm-logger and lcm-spy), an LCM log file, none, and several at once.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "services/record/record_sink.hpp"
#include "services/record/route_watch.hpp"
#include "services/wire/lcm/lcm_log.hpp"
#include "services/wire/lcm/lcm_publisher.hpp"

namespace lockstep {

class LcmSink : public RecordSink {
public:
    /// `watch` keeps the route of the publisher; it may be null.
    explicit LcmSink(LcmPublisher publisher, std::unique_ptr<RouteWatch> watch = nullptr)
        : publisher_(std::move(publisher)), watch_(std::move(watch)) {}
    void write(const std::string& channel, std::int64_t /*utime*/, std::span<const std::uint8_t> bytes) override {
        (void)publisher_.publish_bytes(channel, bytes);
    }
    std::uint64_t failures() const override { return publisher_.failures(); }

private:
    LcmPublisher publisher_;
    std::unique_ptr<RouteWatch> watch_;
};

class LogSink : public RecordSink {
public:
    explicit LogSink(LogWriter writer) : writer_(std::move(writer)) {}
    void write(const std::string& channel, std::int64_t utime, std::span<const std::uint8_t> bytes) override {
        failures_ += writer_.write(channel, utime, bytes) ? 0 : 1;
    }
    /// Returns false if the file is incomplete.
    bool finish() { return writer_.flush() && failures_ == 0; }
    std::uint64_t failures() const override { return failures_; }

private:
    LogWriter writer_;
    std::uint64_t failures_ = 0;
};

/// Records nothing.
class NoSink : public RecordSink {
public:
    void write(const std::string&, std::int64_t, std::span<const std::uint8_t>) override {}
};

/// Writes to several sinks in turn.
class AllSinks : public RecordSink {
public:
    explicit AllSinks(std::vector<std::unique_ptr<RecordSink>> sinks) : sinks_(std::move(sinks)) {}
    void write(const std::string& channel, std::int64_t utime, std::span<const std::uint8_t> bytes) override {
        for (const auto& sink : sinks_) { sink->write(channel, utime, bytes); }
    }
    std::uint64_t failures() const override {
        std::uint64_t sum = 0;
        for (const auto& sink : sinks_) { sum += sink->failures(); }
        return sum;
    }

private:
    std::vector<std::unique_ptr<RecordSink>> sinks_;
};

/// Opens a process's record: the network if `published`, and its own log if the machine's file asks for one. `axis` is
/// the axis's name, empty for the coordinator. If a sink cannot be opened, the function omits it and logs the reason.
std::unique_ptr<RecordSink> open_record(const MachineSetup& machine, const std::string& axis, bool published);

}  // namespace lockstep
