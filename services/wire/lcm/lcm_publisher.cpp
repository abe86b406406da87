#include "services/wire/lcm/lcm_publisher.hpp"

#include "services/network/multicast.hpp"

namespace lockstep {

std::expected<LcmPublisher, std::string> LcmPublisher::open(const NetworkConfig& network) {
    if (network.lcm_url.empty()) {  // LCM would then use an unchecked URL from the environment
        return std::unexpected("the LCM URL is empty; set it, for example to udpm://239.255.76.67:7667?ttl=0");
    }
    if (auto route = check_multicast(network); !route) { return std::unexpected(route.error()); }
    auto lcm = std::make_unique<lcm::LCM>(network.lcm_url);
    if (!lcm->good()) {
        return std::unexpected("LCM refuses the URL " + network.lcm_url +
                               "; write it like udpm://239.255.76.67:7667?ttl=0");
    }
    return LcmPublisher(std::move(lcm));
}

}  // namespace lockstep
