// A process's link to its peers, opened anew when it has ceased to deliver (core/protocol/reception_watch.hpp).
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
    WatchedLink(const MachineConfig& machine, std::unique_ptr<Link> first, typename Reopenable<Link>::Open open)
        : watch_(Ticks{lease_of(machine.network).count() / machine.tick_ns}, machine.tick_ns),
          link_(std::move(first), std::move(open), [](const std::string& why) { tell(why); }) {}

    /// Null while it is being opened anew.
    Link* get() { return link_.get(); }

    /// Once in every loop. look: gives, of the link, what the watch asks for, each time that is due. Why the link is
    /// being opened anew from now on.
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

    /// How often since the process started.
    std::uint64_t reopened() const { return reopened_; }

private:
    ReceptionWatch watch_;
    std::uint64_t reopened_ = 0;
    Reopenable<Link> link_;
};

}  // namespace lockstep
