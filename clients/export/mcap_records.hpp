// The records of an MCAP file (https://mcap.dev/spec): kind, length, fields.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace lockstep::exporting {

inline constexpr std::string_view kMcapMagic{"\x89MCAP0\r\n", 8};

enum class McapKind : std::uint8_t {
    Header = 1,
    Footer = 2,
    Schema = 3,
    Channel = 4,
    Message = 5,
    Chunk = 6,
    MessageIndex = 7,
    ChunkIndex = 8,
    Statistics = 11,
    SummaryOffset = 14,
    DataEnd = 15,
};

/// A record's fields. Numbers are little-endian. A text follows its length, a map the length of its content.
class McapFields {
public:
    template <typename Number>
    McapFields& number(Number value) {
        for (std::size_t byte = 0; byte < sizeof value; ++byte) {
            bytes_.push_back(static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * byte)));
        }
        return *this;
    }
    McapFields& text(std::string_view value) {
        number(static_cast<std::uint32_t>(value.size()));
        return bytes(value);
    }
    McapFields& bytes(std::string_view value) {
        bytes_ += value;
        return *this;
    }
    template <typename Key, typename Value>
    McapFields& map(const std::map<Key, Value>& values) {
        number(static_cast<std::uint32_t>(values.size() * (sizeof(Key) + sizeof(Value))));
        for (const auto& [key, value] : values) { number(key).number(value); }
        return *this;
    }
    operator const std::string&() const { return bytes_; }

private:
    std::string bytes_;
};

inline constexpr std::size_t kMcapHeadBytes = 9;  // a record's kind and length, before its fields

inline std::string mcap_record(McapKind kind, const std::string& fields) {
    return McapFields().number(static_cast<std::uint8_t>(kind)).number(std::uint64_t{fields.size()}).bytes(fields);
}

}  // namespace lockstep::exporting
