// Decodes the record's messages from bytes that may be damaged. The code of lcm-gen trusts the lengths in the bytes,
// and a wrong length makes it allocate gigabytes or throw. So the bytes are first compared with the message's layout.
#pragma once

#include <cstdint>
#include <expected>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <lockstep/axis_health_t.hpp>
#include <lockstep/axis_position_t.hpp>
#include <lockstep/channel_event_t.hpp>
#include <lockstep/flight_event_t.hpp>
#include <lockstep/flight_head_t.hpp>
#include <lockstep/flight_note_t.hpp>
#include <lockstep/job_t.hpp>
#include <lockstep/program_event_t.hpp>
#include <lockstep/program_part_t.hpp>
#include <lockstep/record_loss_t.hpp>
#include <lockstep/record_mark2_t.hpp>
#include <lockstep/record_mark_t.hpp>
#include <lockstep/run_t.hpp>
#include <lockstep/step_batch_t.hpp>

namespace lockstep {

/// The fields in order. '8', '4' and '1' are numbers of that many bytes, and 's' is a string. 'n' is the number of
/// elements of the arrays that follow; a digit after 'n' is an array with elements of that many bytes.
template <typename Message>
inline constexpr std::string_view kLcmLayout;
template <>
inline constexpr std::string_view kLcmLayout<axis_health_t> = "88ss88888888888448881888888888";
template <>
inline constexpr std::string_view kLcmLayout<axis_position_t> = "88ss888888s148";
template <>
inline constexpr std::string_view kLcmLayout<channel_event_t> = "8ss8888888s41488";
template <>
inline constexpr std::string_view kLcmLayout<flight_event_t> = "8ss888ss4s88888";
template <>
inline constexpr std::string_view kLcmLayout<flight_head_t> = "84ss888s8s";
template <>
inline constexpr std::string_view kLcmLayout<flight_note_t> = "8ss8s";
template <>
inline constexpr std::string_view kLcmLayout<job_t> = "8s888sss88888844ssn8";
template <>
inline constexpr std::string_view kLcmLayout<program_event_t> = "8s88888881184s48";
template <>
inline constexpr std::string_view kLcmLayout<program_part_t> = "8s888844n1";
template <>
inline constexpr std::string_view kLcmLayout<record_loss_t> = "8ss88";
template <>
inline constexpr std::string_view kLcmLayout<record_mark2_t> = "8sss818888888";
template <>
inline constexpr std::string_view kLcmLayout<record_mark_t> = "8sss81888888";
template <>
inline constexpr std::string_view kLcmLayout<run_t> = "8ss8888188888188n888n8";
template <>
inline constexpr std::string_view kLcmLayout<step_batch_t> = "8ss8888888n41";

namespace detail {
/// Whether the bytes have exactly this layout.
bool has_layout(std::span<const std::uint8_t> bytes, std::string_view layout);
std::uint64_t big_endian(std::span<const std::uint8_t> bytes);
}  // namespace detail

/// Decodes into a message without elements. If it was used before, the memory of its arrays is used again. Error: what
/// is wrong with the bytes; then the message has any content.
template <typename Message>
std::expected<void, std::string> decode_lcm(std::span<const std::uint8_t> bytes, Message& message) {
    const std::string name = Message::getTypeName();
    if (bytes.size() < 8 || detail::big_endian(bytes.first(8)) != static_cast<std::uint64_t>(Message::getHash())) {
        return std::unexpected("not a " + name + " of this version");
    }
    if (!detail::has_layout(bytes.subspan(8), kLcmLayout<Message>)) { return std::unexpected("a damaged " + name); }
    if (message.decode(bytes.data(), 0, static_cast<int>(bytes.size())) != static_cast<int>(bytes.size())) {
        return std::unexpected("a damaged " + name);
    }
    return {};
}
template <typename Message>
std::expected<Message, std::string> decode_lcm(std::span<const std::uint8_t> bytes) {
    Message message{};
    if (auto decoded = decode_lcm(bytes, message); !decoded) { return std::unexpected(std::move(decoded.error())); }
    return message;
}

}  // namespace lockstep
