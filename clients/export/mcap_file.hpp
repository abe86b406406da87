// MCAP, the container that Foxglove and PlotJuggler read (https://mcap.dev/spec). Each topic has a channel with
// messages in JSON and a JSON Schema. Messages are in the order of the log, in chunks without compression. The summary
// repeats schemas and channels and has the statistics and the index of the chunks, so that readers find messages by
// time and topic. The writer's memory does not grow with the file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>

#include "clients/export/crc32.hpp"
#include "clients/export/mcap_chunk.hpp"
#include "clients/export/mcap_records.hpp"
#include "clients/export/sample_writer.hpp"
#include "services/files/output_file.hpp"

namespace lockstep::exporting {

class McapFile final : public SampleWriter {
public:
    /// The error names the file and the reason.
    static std::expected<McapFile, std::string> create(const std::filesystem::path& path);

    /// log_time: nanoseconds of machine time. Leaves out samples before 0 and topics beyond kMaxTopics.
    void write(const Sample& sample) override;
    std::expected<void, std::string> close() override;
    std::int64_t left_out() const override { return left_out_; }

private:
    static constexpr std::size_t kMaxTopics = 1024;
    struct Channel {
        std::uint16_t id = 0;
        std::uint64_t messages = 0;
    };

    McapFile(std::filesystem::path path, OutputFile out) : path_(std::move(path)), out_(std::move(out)) {}
    Channel* channel(const Sample& sample);
    std::uint16_t schema(const Sample& sample);
    void write_bytes(std::string_view bytes);
    void write_chunk();
    void note_time(std::uint64_t time_ns);
    std::string statistics() const;
    void end_group(McapKind kind, std::uint64_t from);
    void write_group(McapKind kind, const std::string& records);
    std::expected<void, std::string> write_chunk_index(std::uint64_t chunks_end);
    std::expected<void, std::string> write_summary(std::uint64_t chunks_end);

    std::filesystem::path path_;
    OutputFile out_;
    Crc32 crc_;  // of the data section; then of the summary
    McapChunk chunk_;
    std::uint64_t chunks_begin_ = 0;  // place in the file
    std::uint32_t chunks_ = 0;
    std::map<std::string, std::uint16_t> schemas_;  // by name
    std::map<Topic, Channel> channels_;
    std::string schema_records_;
    std::string channel_records_;
    std::string group_records_;  // of the summary: where each group is
    std::uint64_t messages_ = 0;
    std::uint64_t begin_ns_ = 0;
    std::uint64_t end_ns_ = 0;
    std::int64_t left_out_ = 0;
};

}  // namespace lockstep::exporting
