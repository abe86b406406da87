#include "clients/export/mcap_file.hpp"

#include <algorithm>
#include <utility>

#include "clients/export/mcap_json.hpp"

namespace lockstep::exporting {
namespace {

constexpr std::size_t kIndexBytesHeld = std::size_t{1} << 16;

}  // namespace

std::expected<McapFile, std::string> McapFile::create(const std::filesystem::path& path) {
    auto out = OutputFile::create(path);
    if (!out) { return std::unexpected(out.error()); }
    McapFile file(path, std::move(*out));
    file.write_bytes(kMcapMagic);
    file.write_bytes(mcap_record(McapKind::Header, McapFields().text("").text("lockstep")));
    file.chunks_begin_ = file.out_.size();
    return file;
}

void McapFile::write_bytes(std::string_view bytes) {
    crc_.add(bytes);
    out_.write(bytes);
}

/// The schema of all topics of one kind, by the kind's name.
std::uint16_t McapFile::schema(const Sample& sample) {
    const std::string name = printable("lockstep." + sample.topic.substr(sample.topic.rfind('/') + 1));
    const auto [known, is_new] = schemas_.try_emplace(name, static_cast<std::uint16_t>(schemas_.size() + 1));
    if (is_new) {
        const std::string record =
            mcap_record(McapKind::Schema,
                        McapFields().number(known->second).text(name).text("jsonschema").text(json_schema_of(sample)));
        schema_records_ += record;
        chunk_.add(record);
    }
    return known->second;
}

/// Returns null if there are too many topics.
McapFile::Channel* McapFile::channel(const Sample& sample) {
    if (const auto known = channels_.find(sample.topic); known != channels_.end()) { return &known->second; }
    if (channels_.size() == kMaxTopics) { return nullptr; }
    const auto id = static_cast<std::uint16_t>(channels_.size() + 1);
    const std::string record =
        mcap_record(McapKind::Channel,
                    McapFields().number(id).number(schema(sample)).text(printable(sample.topic)).text("json").text(""));
    channel_records_ += record;
    chunk_.add(record);
    return &channels_.emplace(sample.topic, Channel{id, 0}).first->second;
}

void McapFile::write(const Sample& sample) {
    Channel* to = sample.utime >= 0 ? channel(sample) : nullptr;
    if (to == nullptr) {
        ++left_out_;
        return;
    }
    const auto time_ns = static_cast<std::uint64_t>(sample.utime) * 1000;
    const auto number = static_cast<std::uint32_t>(++to->messages);
    note_time(time_ns);
    chunk_.add_message(
        to->id, time_ns,
        mcap_record(McapKind::Message,
                    McapFields().number(to->id).number(number).number(time_ns).number(time_ns).bytes(json_of(sample))));
    if (chunk_.is_full()) { write_chunk(); }
}

void McapFile::note_time(std::uint64_t time_ns) {
    begin_ns_ = messages_ == 0 ? time_ns : std::min(begin_ns_, time_ns);
    end_ns_ = std::max(end_ns_, time_ns);
    ++messages_;
}

void McapFile::write_chunk() {
    if (chunk_.is_empty()) { return; }
    write_bytes(chunk_.take());
    ++chunks_;
}

std::string McapFile::statistics() const {
    std::map<std::uint16_t, std::uint64_t> of_channels;
    for (const auto& [topic, channel] : channels_) { of_channels[channel.id] = channel.messages; }
    return mcap_record(McapKind::Statistics, McapFields()
                                                 .number(messages_)
                                                 .number(static_cast<std::uint16_t>(schemas_.size()))
                                                 .number(static_cast<std::uint32_t>(channels_.size()))
                                                 .number(std::uint32_t{0})  // attachments
                                                 .number(std::uint32_t{0})  // metadata
                                                 .number(chunks_)
                                                 .number(begin_ns_)
                                                 .number(end_ns_)
                                                 .map(of_channels));
}

/// Ends a group of records of one kind, which began at `from`.
void McapFile::end_group(McapKind kind, std::uint64_t from) {
    if (out_.size() == from) { return; }
    group_records_ +=
        mcap_record(McapKind::SummaryOffset,
                    McapFields().number(static_cast<std::uint8_t>(kind)).number(from).number(out_.size() - from));
}

void McapFile::write_group(McapKind kind, const std::string& records) {
    const std::uint64_t from = out_.size();
    write_bytes(records);
    end_group(kind, from);
}

std::expected<void, std::string> McapFile::write_chunk_index(std::uint64_t chunks_end) {
    const std::uint64_t from = out_.size();
    std::string held;
    const auto indexed = index_chunks(path_, chunks_begin_, chunks_end, [&](const std::string& index) {
        held += index;
        if (held.size() >= kIndexBytesHeld) { write_bytes(std::exchange(held, {})); }
    });
    write_bytes(held);
    end_group(McapKind::ChunkIndex, from);
    return indexed;
}

/// The groups, the place of each group, and the footer.
std::expected<void, std::string> McapFile::write_summary(std::uint64_t chunks_end) {
    constexpr std::uint32_t kNoCrc = 0;
    crc_ = Crc32();
    const std::uint64_t begin = out_.size();
    write_group(McapKind::Schema, schema_records_);
    write_group(McapKind::Channel, channel_records_);
    write_group(McapKind::Statistics, statistics());
    const auto indexed = write_chunk_index(chunks_end);
    const std::uint64_t groups_end = out_.size();
    write_bytes(group_records_);
    std::string footer = mcap_record(McapKind::Footer, McapFields().number(begin).number(groups_end).number(kNoCrc));
    footer.resize(footer.size() - sizeof kNoCrc);
    write_bytes(footer);
    const std::string crc = McapFields().number(crc_.value());  // covers the footer's other fields too
    write_bytes(crc);
    return indexed;
}

std::expected<void, std::string> McapFile::close() {
    write_chunk();
    const std::uint64_t chunks_end = out_.size();
    write_bytes(mcap_record(McapKind::DataEnd, McapFields().number(crc_.value())));
    if (!out_.is_written()) { return out_.close(); }
    const auto summary = write_summary(chunks_end);
    write_bytes(kMcapMagic);
    if (const auto closed = out_.close(); !closed) { return closed; }
    return summary;
}

}  // namespace lockstep::exporting
