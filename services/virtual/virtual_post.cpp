#include "services/virtual/virtual_post.hpp"

namespace lockstep {

void VirtualPost::apply(const VirtualFault& fault, bool cuts) {
    const auto link = [&](std::size_t from, std::size_t to) {
        cuts ? network_.cut(address(from), address(to)) : network_.restore(address(from), address(to));
    };
    for (std::size_t peer = 0; peer < processes_; ++peer) {
        if (peer == fault.process || (fault.peer && peer != *fault.peer)) { continue; }
        if (fault.outgoing) {
            link(fault.process, peer);
            link(fault.process, clock_of(peer));
        }
        if (fault.incoming) {
            link(peer, fault.process);
            link(peer, clock_of(fault.process));
        }
    }
}

}  // namespace lockstep
