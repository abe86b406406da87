#include "services/virtual/virtual_network.hpp"

#include <iterator>

namespace lockstep {

bool VirtualNetwork::happens(double probability) {
    return probability > 0 && static_cast<double>(random_() >> 11) * 0x1p-53 < probability;
}

bool VirtualNetwork::is_cut(Address from, Address to) const {
    if (cuts_.empty()) { return false; }
    const auto link = cuts_.find({from, to});
    return link != cuts_.end() && link->second > 0;
}

void VirtualNetwork::send(Tick now, Address from, Address to, SharedMessage message) {
    if (is_cut(from, to) || happens(behaviour_.lost)) { return; }
    if (to != trusted_ && happens(behaviour_.corrupted)) { message = altered(message); }
    if (happens(behaviour_.duplicated)) { post(now, to, message); }
    post(now, to, std::move(message));
}

SharedMessage VirtualNetwork::altered(const SharedMessage& message) {
    auto copy = std::make_shared<VirtualMessage>(*message);
    const Alteration how = alter(*copy, random_);
    ++alterations_[static_cast<std::size_t>(how)];
    return copy;
}

void VirtualNetwork::post(Tick now, Address to, SharedMessage message) {
    if (mailboxes_.size() <= to) { mailboxes_.resize(to + 1); }
    const auto spread = static_cast<std::uint64_t>((behaviour_.delay_max - behaviour_.delay_min).value) + 1;
    const Ticks delay = behaviour_.delay_min + Ticks{static_cast<std::int64_t>(random_() % spread)};
    Mailbox& mailbox = mailboxes_[to];
    auto place = mailbox.end();
    while (place != mailbox.begin() && std::prev(place)->arrives > now + delay) { --place; }
    mailbox.insert(place, {now + delay, std::move(message)});
}

}  // namespace lockstep
