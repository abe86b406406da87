// Publishes the record. Control does not depend on it, so a message that cannot be sent is only counted.
#pragma once

#include <cstdint>
#include <expected>
#include <memory>
#include <span>
#include <string>

#include <lcm/lcm-cpp.hpp>

#include "services/setup/machine_setup.hpp"

namespace lockstep {

class LcmPublisher {
public:
    /// Error: a bad URL, or a multicast route through another interface than the configured one; and the remedy.
    static std::expected<LcmPublisher, std::string> open(const NetworkConfig& network);

    /// `Message` is a type made by lcm-gen. Returns whether the message was sent.
    template <typename Message>
    bool publish(const std::string& channel, const Message& message) {
        const bool sent = lcm_->publish(channel, &message) == 0;
        failures_ += sent ? 0 : 1;
        return sent;
    }

    /// The same for an encoded message.
    bool publish_bytes(const std::string& channel, std::span<const std::uint8_t> bytes) {
        const bool sent = lcm_->publish(channel, bytes.data(), static_cast<unsigned int>(bytes.size())) == 0;
        failures_ += sent ? 0 : 1;
        return sent;
    }

    std::uint64_t failures() const { return failures_; }

private:
    explicit LcmPublisher(std::unique_ptr<lcm::LCM> lcm) : lcm_(std::move(lcm)) {}

    std::unique_ptr<lcm::LCM> lcm_;
    std::uint64_t failures_ = 0;
};

}  // namespace lockstep
