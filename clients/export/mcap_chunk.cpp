#include "clients/export/mcap_chunk.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <utility>

#include "clients/export/crc32.hpp"
#include "clients/export/mcap_records.hpp"

namespace lockstep::exporting {
namespace {

constexpr std::string_view kNoCompression;

/// The first fields of a record, read from a file.
class RecordHead {
public:
    /// Chunk: both times and the size of its records are in its first bytes. MessageIndex: so is its channel.
    static constexpr std::size_t kFieldBytes = 24;

    /// Returns false at the file's end.
    bool read(std::ifstream& in, std::uint64_t at) {
        in.seekg(static_cast<std::streamoff>(at));
        in.read(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
        return in.good();
    }
    McapKind kind() const { return static_cast<McapKind>(bytes_[0]); }
    std::uint64_t bytes() const { return kMcapHeadBytes + number<std::uint64_t>(1); }
    template <typename Number>
    Number field(std::size_t at) const {
        return number<Number>(kMcapHeadBytes + at);
    }

private:
    template <typename Number>
    Number number(std::size_t at) const {
        Number value{};
        for (std::size_t byte = sizeof value; byte-- > 0;) {
            value = static_cast<Number>((std::uint64_t{value} << 8U) | static_cast<std::uint8_t>(bytes_[at + byte]));
        }
        return value;
    }

    std::array<char, kMcapHeadBytes + kFieldBytes> bytes_{};
};

struct IndexedChunk {
    RecordHead head;
    std::uint64_t at = 0;
    std::map<std::uint16_t, std::uint64_t> indexes;  // by channel: where its message index is
    std::uint64_t end = 0;                           // of the last message index

    std::string record() const {
        const auto size = head.field<std::uint64_t>(16);
        return mcap_record(McapKind::ChunkIndex, McapFields()
                                                     .number(head.field<std::uint64_t>(0))
                                                     .number(head.field<std::uint64_t>(8))
                                                     .number(at)
                                                     .number(head.bytes())
                                                     .map(indexes)
                                                     .number(end - at - head.bytes())
                                                     .text(kNoCompression)
                                                     .number(size)
                                                     .number(size));
    }
};

}  // namespace

void McapChunk::add_message(std::uint16_t channel, std::uint64_t time_ns, std::string_view record) {
    const bool is_first = index_.empty();
    begin_ns_ = is_first ? time_ns : std::min(begin_ns_, time_ns);
    end_ns_ = is_first ? time_ns : std::max(end_ns_, time_ns);
    index_[channel] += McapFields().number(time_ns).number(std::uint64_t{records_.size()});
    records_ += record;
}

std::string McapChunk::take() {
    std::string out = mcap_record(McapKind::Chunk, McapFields()
                                                       .number(begin_ns_)
                                                       .number(end_ns_)
                                                       .number(std::uint64_t{records_.size()})
                                                       .number(Crc32().add(records_).value())
                                                       .text(kNoCompression)
                                                       .number(std::uint64_t{records_.size()})
                                                       .bytes(records_));
    for (const auto& [channel, entries] : index_) {
        out += mcap_record(McapKind::MessageIndex, McapFields().number(channel).text(entries));
    }
    *this = McapChunk();
    return out;
}

std::expected<void, std::string> index_chunks(const std::filesystem::path& path, std::uint64_t from, std::uint64_t to,
                                              const std::function<void(const std::string&)>& on_index) {
    std::ifstream in(path, std::ios::binary);
    IndexedChunk chunk;
    RecordHead head;
    for (std::uint64_t at = from; at < to; at += head.bytes()) {
        if (!head.read(in, at)) { return std::unexpected(path.string() + ": cannot be read to write its index"); }
        if (head.kind() == McapKind::Chunk) {
            if (at != from) { on_index(chunk.record()); }
            chunk = {.head = head, .at = at};
        } else {
            chunk.indexes[head.field<std::uint16_t>(0)] = at;
        }
        chunk.end = at + head.bytes();
    }
    if (to > from) { on_index(chunk.record()); }
    return {};
}

}  // namespace lockstep::exporting
