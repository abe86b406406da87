// Typed readers and writers of core's messages. A writer translates each message. A reader checks each message first,
// and accepts a message about an axis only from that axis's own writer.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "core/protocol/reception_watch.hpp"
#include "services/wire/bus/partition_check.hpp"
#include "services/wire/dds/entity.hpp"
#include "services/wire/dds/participant.hpp"
#include "services/wire/dds/refusals.hpp"
#include "services/wire/dds/topics.hpp"
#include "services/wire/translate/translate.hpp"

namespace lockstep {

/// Called on a thread of DDS when samples have arrived. It must be short and must not throw.
using OnData = std::function<void()>;

namespace detail {
/// Notes for a reader that samples have arrived. DDS calls it on one of its threads.
struct Arrival {
    explicit Arrival(OnData also) : on_data(std::move(also)) {}
    std::atomic<bool> has_come{false};
    OnData on_data;
};

/// If creation fails, the participant notes it and the entity is not valid.
Entity make_writer(Participant& participant, const TopicSpec& spec);
Entity make_reader(Participant& participant, const TopicSpec& spec, Arrival& arrival);
std::uint32_t matched_readers(const Entity& writer);
std::uint32_t matched_writers(const Entity& reader);
/// Bytes that DDS received for the reader but did not deliver, since the reader's creation.
std::uint64_t discarded_bytes(const Entity& reader);

/// Returns the axis that a message is about. nullopt: it is about no axis, and any permitted writer of the topic may
/// send it.
template <typename T>
std::optional<std::uint32_t> spoken_for(const T& message) {
    constexpr bool kIsAnAxiss =
        std::is_same_v<T, AxisState> || std::is_same_v<T, AxisHealth> || std::is_same_v<T, ClockRequest>;
    if constexpr (kIsAnAxiss) { return message.axis; }
    return std::nullopt;
}
}  // namespace detail

template <typename T>
class Writer {
public:
    explicit Writer(Participant& participant) : entity_(detail::make_writer(participant, Topic<T>::kSpec)) {}

    /// Never waits. Returns false if the network's buffers are full or DDS is shutting down.
    bool write(const T& value) {
        to_wire(value, message_);
        const typename Topic<T>::Wire* sample = &message_;
        return dds_write(entity_.handle(), sample) == DDS_RETCODE_OK;
    }

    /// The number of matched readers. A message without a matched reader is lost, so a client waits for one before its
    /// first command.
    std::uint32_t matched() const { return detail::matched_readers(entity_); }

private:
    Entity entity_;
    decltype(to_wire(std::declval<const T&>())) message_{};  // the message written last
};

template <typename T>
class Reader {
public:
    explicit Reader(Participant& participant, OnData on_data = {})
        : arrival_(std::make_unique<detail::Arrival>(std::move(on_data))),
          entity_(detail::make_reader(participant, Topic<T>::kSpec, *arrival_)),
          partitions_(participant.machine()) {}

    /// The most messages that can wait for take(), if so many axes send them.
    static constexpr std::size_t most_waiting(std::size_t axes) { return axes * Topic<T>::kSpec.depth; }
    /// Calls use(T&&) for each message received since the last call, oldest first per sender. Returns their number. If
    /// `use` does not move from a message, the next one reuses its memory.
    template <typename Use>
    std::size_t take(Use use) {
        std::size_t used = 0;
        if (!arrival_->has_come.exchange(false)) { return used; }  // a loop asks often, and a DDS call takes locks
        for (std::size_t batch = 0; batch < kMaxBatches; ++batch) {
            if (take_batch(use, used) < kBatch) { return used; }
        }
        arrival_->has_come = true;
        return used;
    }

    const Refusals& refusals() const { return refusals_; }
    std::uint32_t matched() const { return detail::matched_writers(entity_); }
    TopicReception reception() const { return {received_, detail::discarded_bytes(entity_)}; }

private:
    static constexpr std::size_t kBatch = 64;
    static constexpr std::size_t kMaxBatches = 64;  // in a flood, the next call takes the rest

    /// Samples lent by DDS. The destructor returns them.
    struct Loan {
        dds_entity_t reader;
        std::array<void*, kBatch> samples{};
        std::array<dds_sample_info_t, kBatch> infos{};
        int count = 0;
        explicit Loan(dds_entity_t from) : reader(from) {
            count = dds_take(reader, samples.data(), infos.data(), kBatch, kBatch);
        }
        Loan(const Loan&) = delete;
        Loan& operator=(const Loan&) = delete;
        ~Loan() {
            if (count > 0) { dds_return_loan(reader, samples.data(), count); }
        }
    };

    template <typename Use>
    std::size_t take_batch(Use& use, std::size_t& used) {
        const Loan loan(entity_.handle());
        const auto count = static_cast<std::size_t>(std::max(0, loan.count));
        for (std::size_t i = 0; i < count; ++i) {
            if (!loan.infos[i].valid_data) { continue; }  // a writer left
            ++received_;
            auto believed = from_wire(*static_cast<const typename Topic<T>::Wire*>(loan.samples[i]), value_);
            if (believed) { believed = check_writer(loan.infos[i].publication_handle); }
            if (believed) {
                use(std::move(value_));
                ++used;
            } else {
                refusals_.add(std::move(believed.error()));
            }
        }
        return count;
    }

    std::expected<void, std::string> check_writer(dds_instance_handle_t writer) {
        const auto axis = detail::spoken_for(value_);
        if (!axis || partitions_.may_write_for(entity_.handle(), writer, *axis)) { return {}; }
        return std::unexpected(
            fmt::format("{}: is about axis {}, but its writer is not that axis", Topic<T>::kSpec.name, *axis));
    }

    std::unique_ptr<detail::Arrival> arrival_;  // DDS holds its address, so it must not move and must outlive entity_
    Entity entity_;
    PartitionCheck partitions_;
    T value_{};  // the message being read
    std::uint64_t received_ = 0;
    Refusals refusals_;
};

}  // namespace lockstep
