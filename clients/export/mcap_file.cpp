#include "clients/export/mcap_file.hpp"

#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

namespace lockstep::exporting {
namespace {

constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};
enum Opcode : std::uint8_t { kHeader = 1, kFooter = 2, kSchema = 3, kChannel = 4, kMessage = 5, kDataEnd = 15 };

/// A record's fields. Numbers are little-endian; a text follows its length.
class Fields {
public:
    template <typename Number>
    Fields& number(Number value) {
        for (std::size_t byte = 0; byte < sizeof value; ++byte) {
            bytes_.push_back(static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * byte)));
        }
        return *this;
    }
    Fields& text(std::string_view value) {
        number(static_cast<std::uint32_t>(value.size()));
        return bytes(value);
    }
    Fields& bytes(std::string_view value) {
        bytes_ += value;
        return *this;
    }
    operator const std::string&() const { return bytes_; }

private:
    std::string bytes_;
};

/// Names in a damaged log may be any bytes, but JSON must be UTF-8.
std::string printable(std::string text) {
    for (char& c : text) { c = c >= ' ' && c <= '~' ? c : '?'; }
    return text;
}

using google::protobuf::Struct;

std::string to_json(const Struct& object) {
    std::string json;
    (void)google::protobuf::util::MessageToJsonString(object, &json);
    return json;
}

const char* type_of(const Value& value) {
    constexpr const char* kTypes[] = {"number", "integer", "string"};
    return kTypes[value.index()];
}

std::string schema_of(const Sample& sample) {
    Struct schema;
    auto& fields = *schema.mutable_fields();
    fields["type"].set_string_value("object");
    auto& properties = *fields["properties"].mutable_struct_value()->mutable_fields();
    for (const Signal& signal : sample.signals) {
        auto& property = *properties[std::string(signal.name)].mutable_struct_value()->mutable_fields();
        property["type"].set_string_value(type_of(signal.value));
    }
    return to_json(schema);
}

/// Leaves out values that are not finite, because JSON cannot represent them.
std::string message_of(const Sample& sample) {
    Struct message;
    for (const auto& [name, value] : sample.signals) {
        google::protobuf::Value field;
        if (const auto* text = std::get_if<std::string>(&value)) {
            field.set_string_value(printable(*text));
        } else if (const auto* whole = std::get_if<std::int64_t>(&value)) {
            field.set_number_value(static_cast<double>(*whole));
        } else if (std::isfinite(std::get<double>(value))) {
            field.set_number_value(std::get<double>(value));
        } else {
            continue;
        }
        (*message.mutable_fields())[std::string(name)] = field;
    }
    return to_json(message);
}

}  // namespace

std::expected<McapFile, std::string> McapFile::create(const std::filesystem::path& path) {
    errno = 0;
    std::ofstream out(path, std::ios::binary | std::ios::trunc);
    if (!out) { return std::unexpected(path.string() + ": cannot be written: " + std::strerror(errno)); }
    McapFile file(path, std::move(out));
    file.out_ << kMagic;
    file.record(kHeader, Fields().text("").text("lockstep"));
    return file;
}

void McapFile::record(std::uint8_t opcode, const std::string& content) {
    const std::string head = Fields().number(opcode).number(static_cast<std::uint64_t>(content.size()));
    out_ << head << content;
}

/// A channel and its schema have the same number. Returns null if there are too many topics.
McapFile::Channel* McapFile::channel(const Sample& sample) {
    if (const auto known = channels_.find(sample.topic); known != channels_.end()) { return &known->second; }
    if (channels_.size() == kMaxTopics) { return nullptr; }
    const auto id = static_cast<std::uint16_t>(channels_.size() + 1);
    const std::string name = "lockstep." + sample.topic.substr(sample.topic.rfind('/') + 1);
    record(kSchema, Fields().number(id).text(name).text("jsonschema").text(schema_of(sample)));
    record(kChannel, Fields().number(id).number(id).text(printable(sample.topic)).text("json").text(""));
    return &channels_.emplace(sample.topic, Channel{id, 0}).first->second;
}

void McapFile::write(const Sample& sample) {
    Channel* to = sample.utime >= 0 ? channel(sample) : nullptr;
    if (to == nullptr) {
        ++left_out_;
        return;
    }
    const auto time_ns = static_cast<std::uint64_t>(sample.utime) * 1000;
    record(kMessage,
           Fields().number(to->id).number(++to->messages).number(time_ns).number(time_ns).bytes(message_of(sample)));
}

std::expected<void, std::string> McapFile::close() {
    record(kDataEnd, Fields().number(std::uint32_t{0}));
    record(kFooter, Fields().number(std::uint64_t{0}).number(std::uint64_t{0}).number(std::uint32_t{0}));
    out_ << kMagic;
    errno = 0;
    out_.close();
    if (!out_) { return std::unexpected(path_.string() + ": not written completely: " + std::strerror(errno)); }
    return {};
}

}  // namespace lockstep::exporting
