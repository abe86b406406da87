// MCAP, the container that Foxglove and PlotJuggler read (https://mcap.dev/spec). Each topic has a channel with
// messages in JSON and a JSON Schema. Records are in the order of the log. Chunks, index and checksums are optional in
// the format and left out; readers go through the file once.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>

#include "clients/export/sample_writer.hpp"

namespace lockstep::exporting {

class McapFile final : public SampleWriter {
public:
    /// The error names the file and the reason.
    static std::expected<McapFile, std::string> create(const std::filesystem::path& path);

    /// log_time: nanoseconds of machine time.
    void write(const Sample& sample) override;
    std::expected<void, std::string> close() override;
    std::int64_t left_out() const override { return left_out_; }

private:
    static constexpr std::size_t kMaxTopics = 1024;
    struct Channel {
        std::uint16_t id = 0;
        std::uint32_t messages = 0;
    };

    McapFile(std::filesystem::path path, std::ofstream out) : path_(std::move(path)), out_(std::move(out)) {}
    Channel* channel(const Sample& sample);
    void record(std::uint8_t opcode, const std::string& content);

    std::filesystem::path path_;
    std::ofstream out_;
    std::map<Topic, Channel> channels_;
    std::int64_t left_out_ = 0;
};

}  // namespace lockstep::exporting
