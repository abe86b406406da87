#include "clients/scenario/runner/containers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "clients/scenario/runner/control_groups.hpp"
#include "clients/scenario/runner/sandbox.hpp"

namespace lockstep::scenario {
namespace {

constexpr const char* kImages = "store {{.Store.GraphDriverName}} {{.Store.GraphRoot}}";
constexpr const char* kBuild = "podman build -t lockstep -f deploy/Dockerfile .";

// Podman writes nothing on the host; a container's user has no rights.
constexpr const char* kPodman =
    "podman --root /dev/shm/podman --runroot /run/podman --cgroup-manager cgroupfs --events-backend none";
constexpr const char* kRun =
    "run --rm --log-driver none --cgroups no-conmon --ipc host --read-only --cap-drop ALL "
    "--security-opt no-new-privileges";

}  // namespace

std::expected<Containers, std::string> Containers::of(const std::string& image) {
    const auto output = output_of_program({"podman", "info", "--format", kImages});
    if (!output) { return std::unexpected("no container can be run: " + output.error()); }
    if (!output_of_program({"podman", "image", "exists", image})) {
        return std::unexpected(
            fmt::format("podman has no image {}; build it: {}, or name one by --image", image, kBuild));
    }
    Containers containers;
    containers.image_ = image;
    containers.group_ = own_control_group();
    std::istringstream found(output->substr(std::min(output->find("store "), output->size())));
    std::string store;
    found >> store >> containers.driver_ >> containers.store_;
    if (containers.store_.empty()) {
        return std::unexpected("podman does not report where its images are: " + *output);
    }
    return containers;
}

CommandLine Containers::entry(const std::string& process, const std::string& network) const {
    const std::string joins = network.empty() ? "none" : "ns:/run/netns/" + network;
    const std::string pid_file = pid_folder() / (process + ".pid");
    const std::string state = sandbox_folder() / "state";
    CommandLine line = split_words(kPodman);
    line.insert(line.end(), {"--storage-driver", driver_, "--storage-opt", "additionalimagestore=" + store_});
    for (const std::string& word : split_words(kRun)) { line.push_back(word); }
    line.insert(line.end(), {"--cgroup-parent", "/" + group_, "--name", process, "--pidfile", pid_file, "--network",
                             joins, "--env", "LOCKSTEP_STATE=" + state, image_});
    return line;
}

std::filesystem::path Containers::pid_folder() { return "/run"; }

}  // namespace lockstep::scenario
