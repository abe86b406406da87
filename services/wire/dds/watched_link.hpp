// A process's link to its peers. It is reopened when it no longer delivers (core/protocol/reception_watch.hpp).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/protocol/reception_watch.hpp"
#include "services/wire/dds/dds_log.hpp"
#include "services/wire/dds/domain.hpp"
#include "services/wire/dds/reopenable.hpp"

namespace lockstep {

template <typename Link>
class WatchedLink {
public:
    WatchedLink(const MachineSetup& machine, std::unique_ptr<Link> first, typename Reopenable<Link>::Open open)
        : watch_(Ticks{lease_of(machine.network).count() / machine.tick_ns}, machine.tick_ns),
          link_(std::move(first), std::move(open), [](const std::string& why) { add_dds_message(why); }) {}

    /// Null while the link is being reopened.
    Link* get() { return link_.get(); }

    /// Call it in every loop. It calls `look` when a check is due; look(link) returns the input of the watch. If the
    /// link no longer delivers, it reopens the link and returns the reason.
    template <typename Look>
    std::optional<ReopenReason> tend(Tick now, Look look) {
        Link* const link = get();
        if (link == nullptr || !watch_.is_due(now)) { return std::nullopt; }
        const auto reason = watch_.look(now, look(*link));
        if (reason) {
            ++reopened_;
            link_.reopen();
        }
        return reason;
    }

    /// How often the link was reopened since the process started.
    std::uint64_t reopened() const { return reopened_; }

private:
    ReceptionWatch watch_;
    std::uint64_t reopened_ = 0;
    Reopenable<Link> link_;
};

}  // namespace lockstep
