#include "clients/scenario/runner/containers.hpp"

#include <algorithm>
#include <sstream>

#include "clients/scenario/runner/control_groups.hpp"
#include "clients/scenario/runner/world.hpp"

namespace lockstep::scenario {
namespace {

constexpr const char* kImages = "store {{.Store.GraphDriverName}} {{.Store.GraphRoot}}";
constexpr const char* kBuild = "podman build -t lockstep -f deploy/Dockerfile .";

// Nothing that podman writes is the host's; a container's user has no rights.
constexpr const char* kPodman =
    "podman --root /dev/shm/podman --runroot /run/podman --cgroup-manager cgroupfs --events-backend none";
constexpr const char* kRun =
    "run --rm --log-driver none --cgroups no-conmon --ipc host --read-only --cap-drop ALL "
    "--security-opt no-new-privileges";

}  // namespace

std::expected<Containers, std::string> Containers::of(const std::string& image) {
    const auto said = said_by_program({"podman", "info", "--format", kImages});
    if (!said) { return std::unexpected("no container can be run: " + said.error()); }
    if (!said_by_program({"podman", "image", "exists", image})) {
        return std::unexpected("podman has no image " + image + "; build it: " + kBuild + ", or name one by --image");
    }
    Containers containers;
    containers.image_ = image;
    containers.group_ = own_control_group();
    std::istringstream found(said->substr(std::min(said->find("store "), said->size())));
    std::string store;
    found >> store >> containers.driver_ >> containers.store_;
    if (containers.store_.empty()) { return std::unexpected("podman does not tell where its images are: " + *said); }
    return containers;
}

Words Containers::entry(const std::string& process, const std::string& network) const {
    const std::string joins = network.empty() ? "none" : "ns:/run/netns/" + network;
    const std::string number = numbers() / (process + ".pid");
    const std::string state = world_folder() / "state";
    Words line = words_of(kPodman);
    line.insert(line.end(), {"--storage-driver", driver_, "--storage-opt", "additionalimagestore=" + store_});
    for (const std::string& word : words_of(kRun)) { line.push_back(word); }
    line.insert(line.end(), {"--cgroup-parent", "/" + group_, "--name", process, "--pidfile", number, "--network",
                             joins, "--env", "LOCKSTEP_STATE=" + state, image_});
    return line;
}

std::filesystem::path Containers::numbers() { return "/run"; }

}  // namespace lockstep::scenario
