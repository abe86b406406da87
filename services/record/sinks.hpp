// The two sinks there are: LCM's network, for lcm-logger and lcm-spy, and LCM's log file, for the simulator.
#pragma once

#include <memory>
#include <utility>

#include "services/record/record_sink.hpp"
#include "services/wire/lcm_log.hpp"
#include "services/wire/lcm_publisher.hpp"

namespace lockstep {

class LcmSink : public RecordSink {
public:
    explicit LcmSink(LcmPublisher publisher) : publisher_(std::move(publisher)) {}
    void write(const std::string& channel, std::int64_t /*utime*/, std::span<const std::uint8_t> bytes) override {
        (void)publisher_.publish_bytes(channel, bytes);
    }
    std::uint64_t failures() const override { return publisher_.failures(); }

private:
    LcmPublisher publisher_;
};

class LogSink : public RecordSink {
public:
    explicit LogSink(LogWriter writer) : writer_(std::move(writer)) {}
    void write(const std::string& channel, std::int64_t utime, std::span<const std::uint8_t> bytes) override {
        failures_ += writer_.write(channel, utime, bytes) ? 0 : 1;
    }
    /// False: the file lacks something.
    bool finish() { return writer_.flush() && failures_ == 0; }
    std::uint64_t failures() const override { return failures_; }

private:
    LogWriter writer_;
    std::uint64_t failures_ = 0;
};

/// Where nothing is recorded.
class NoSink : public RecordSink {
public:
    void write(const std::string&, std::int64_t, std::span<const std::uint8_t>) override {}
};

/// The network's, or none where the record is not wanted or cannot be published: the log says why.
std::unique_ptr<RecordSink> open_record(const NetworkConfig& network, bool wanted);

}  // namespace lockstep
