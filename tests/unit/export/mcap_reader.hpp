// Reads the records of an MCAP file, for tests of its structure. Written from https://mcap.dev/spec, without code of
// the writer.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep::exporting {

/// Reads fields one after the other. Fails the test at the record's end.
class FieldReader {
public:
    explicit FieldReader(std::string_view bytes) : rest_(bytes) {}
    std::string_view bytes(std::size_t count) {
        EXPECT_LE(count, rest_.size()) << "a record ends within a field";
        const std::string_view taken = rest_.substr(0, std::min(count, rest_.size()));
        rest_.remove_prefix(taken.size());
        return taken;
    }
    std::uint64_t number(std::size_t size) {
        std::uint64_t value = 0;
        const std::string_view taken = bytes(size);
        for (std::size_t i = taken.size(); i-- > 0;) { value = value << 8U | static_cast<std::uint8_t>(taken[i]); }
        return value;
    }
    std::uint64_t u16() { return number(2); }
    std::uint64_t u32() { return number(4); }
    std::uint64_t u64() { return number(8); }
    std::string text() { return std::string(bytes(u32())); }
    /// Of channel numbers to 8-byte numbers.
    std::map<std::uint64_t, std::uint64_t> map() {
        std::map<std::uint64_t, std::uint64_t> values;
        for (FieldReader entries(bytes(u32())); !entries.is_at_end();) {
            const std::uint64_t key = entries.u16();
            values[key] = entries.u64();
        }
        return values;
    }
    bool is_at_end() const { return rest_.empty(); }

private:
    std::string_view rest_;
};

struct McapRecordRead {
    int kind = 0;
    std::uint64_t at = 0;  // in the text that was read
    std::string_view fields;
    std::uint64_t size() const { return 9 + fields.size(); }
    FieldReader read() const { return FieldReader(fields); }
};

/// The records that fill `bytes` from `from` on.
inline std::vector<McapRecordRead> records_of(std::string_view bytes, std::uint64_t from = 0) {
    std::vector<McapRecordRead> records;
    while (from < bytes.size()) {
        FieldReader head(bytes.substr(from));
        const auto kind = static_cast<int>(head.number(1));
        records.push_back({kind, from, head.bytes(head.u64())});
        from += records.back().size();
    }
    return records;
}

inline std::vector<McapRecordRead> of_kind(const std::vector<McapRecordRead>& records, int kind) {
    std::vector<McapRecordRead> out;
    std::ranges::copy_if(records, std::back_inserter(out), [&](const auto& record) { return record.kind == kind; });
    return out;
}

/// CRC-32 bit by bit.
inline std::uint32_t slow_crc32(std::string_view bytes) {
    std::uint32_t rest = 0xFFFFFFFF;
    for (const char c : bytes) {
        rest ^= static_cast<std::uint8_t>(c);
        for (int bit = 0; bit < 8; ++bit) { rest = (rest >> 1U) ^ ((rest & 1U) * 0xEDB88320U); }
    }
    return ~rest;
}

}  // namespace lockstep::exporting
