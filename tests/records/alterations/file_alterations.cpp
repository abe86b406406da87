// Log files whose bytes are damaged.
#include <fstream>
#include <iterator>

#include "tests/records/alterations/alterations.hpp"

namespace lockstep::records {
namespace {

/// A part of the file cannot be read: what was in it is not known.
constexpr Expected kDamaged{kSaysUnknown, kSaysDoubtful | kSaysUnknown, kSaysUnknown, kSaysUnknown};
constexpr Expected kNoLog{kSaysRefused, kSaysRefused, kSaysRefused, kSaysRefused};

std::size_t middle_byte(const std::string& bytes) { return bytes.size() / 2; }

/// The first byte of a message of steps behind the middle. Its channel's name follows its header.
std::size_t event_in_the_middle(const std::string& bytes) {
    const std::size_t name = bytes.find("_STEPS", middle_byte(bytes));
    return bytes.rfind(std::string("\xED\xA1\xDA\x01", 4), name);
}

}  // namespace

const std::vector<FileAlteration>& file_alterations() {
    static const std::vector<FileAlteration> all{
        {"file_cut_in_the_middle",
         [](std::string& bytes) { bytes.resize(middle_byte(bytes)); },
         {kSaysGood | kSaysUnknown, kSaysDoubtful | kSaysUnknown, kSaysUnknown, kSaysGood | kSaysUnknown}},
        {"file_without_its_last_bytes",
         [](std::string& bytes) { bytes.resize(bytes.size() - 10); },
         {kSaysGood | kSaysUnknown, kSaysGood | kSaysDoubtful | kSaysUnknown, kSaysUnknown, kSaysGood | kSaysUnknown}},
        {"file_with_a_damaged_header", [](std::string& bytes) { bytes[event_in_the_middle(bytes) + 1] ^= 0x10; },
         kDamaged},
        {"file_with_a_wrong_length", [](std::string& bytes) { bytes[event_in_the_middle(bytes) + 25] ^= 0x7f; },
         kDamaged},
        {"file_with_garbage_inserted",
         [](std::string& bytes) { bytes.insert(event_in_the_middle(bytes), std::string(1000, 'x')); },
         {kSaysGood | kSaysUnknown, kSaysDoubtful | kSaysUnknown, kSaysUnknown, kSaysGood | kSaysUnknown}},
        {"file_with_a_block_of_zeros",
         [](std::string& bytes) { bytes.replace(middle_byte(bytes), 4096, std::string(4096, '\0')); }, kDamaged},
        {"file_without_its_first_bytes",
         [](std::string& bytes) { bytes.erase(0, 10); },
         {kSaysGood | kSaysUnknown, kSaysGood | kSaysDoubtful | kSaysUnknown, kSaysUnknown, kSaysGood | kSaysUnknown}},
        {"file_twice_in_one",
         [](std::string& bytes) { bytes += std::string(bytes); },
         {kSaysGood | kSaysUnknown, kSaysGood | kSaysDoubtful | kSaysUnknown, kSaysGood | kSaysBad | kSaysUnknown,
          kSaysGood | kSaysUnknown}},
        {"file_empty", [](std::string& bytes) { bytes.clear(); }, kNoLog},
        {"file_of_text", [](std::string& bytes) { bytes = "G0 X1\nG0 X2\n"; }, kNoLog},
        {"file_of_zeros", [](std::string& bytes) { bytes.assign(5000, '\0'); }, kNoLog},
    };
    return all;
}

Judgement judge_damaged(const FileAlteration& damage) {
    const auto log = record_folder() / "damaged.lcm";
    write_record(record_of(bases().front()), log);
    std::ifstream in(log, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(in), {}};
    damage.alter(bytes);
    std::ofstream(log, std::ios::binary) << bytes;
    Judgement judgement = judge_file(log);
    std::filesystem::remove(log);
    return judgement;
}

}  // namespace lockstep::records
