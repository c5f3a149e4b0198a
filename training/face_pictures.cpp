#include "training/face_pictures.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <sstream>
#include <stdexcept>

#include "encoder/image/planes.h"
#include "training/talker_faces.h"

namespace fbs {
namespace {

/// Lines of a CSV file by the names of its columns.
class Csv {
 public:
  explicit Csv(const std::filesystem::path& path) : file_(path) {
    if (!file_) throw std::runtime_error("cannot read " + path.string());
    next();
    for (std::size_t i = 0; i < cells_.size(); ++i) columns_[cells_[i]] = i;
  }

  /// @return false after the last line
  bool next() {
    std::string line;
    if (!std::getline(file_, line)) return false;
    cells_.clear();
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) cells_.push_back(cell);
    return true;
  }

  /// @return "" where the line has no such cell
  [[nodiscard]] std::string text(const std::string& column) const {
    const auto found = columns_.find(column);
    return found != columns_.end() && found->second < cells_.size() ? cells_[found->second] : "";
  }

  /// @return false where a point is missing
  [[nodiscard]] bool read(Shape& shape) const {
    for (std::size_t k = 0; k < shape.size(); ++k) {
      const std::string number = std::to_string(k), x = text(std::string("x").append(number)),
                        y = text(std::string("y").append(number));
      if (x.empty() || y.empty() || x == "nan") return false;
      shape[k] = {std::stof(x), std::stof(y)};
    }
    return true;
  }

 private:
  std::ifstream file_;
  std::vector<std::string> cells_;
  std::map<std::string, std::size_t> columns_;
};

/// The person that each file shows.
class Persons {
 public:
  explicit Persons(const std::filesystem::path& path) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error("cannot read " + path.string());
    for (std::string line; std::getline(file, line);) {
      std::istringstream in(line.substr(0, line.find('#')));
      std::string picture, person;
      if (in >> picture >> person) persons_[picture] = person;
    }
  }

  /// @return `file` where the list does not name it
  [[nodiscard]] std::string of(const std::string& file) const {
    const auto found = persons_.find(file);
    return found != persons_.end() ? found->second : file;
  }

 private:
  std::map<std::string, std::string> persons_;
};

void add_clip(const std::filesystem::path& clip, const std::filesystem::path& reference,
              const Persons& persons, int count, std::vector<FacePicture>& out) {
  std::vector<Shape> shapes;
  for (Csv csv(reference); csv.next();) {
    Shape shape;
    const bool found = csv.text("found") != "0" && csv.read(shape);
    shapes.push_back(found ? shape : Shape{});
  }
  const auto every = std::max<std::size_t>(1, shapes.size() / static_cast<std::size_t>(count));
  cv::VideoCapture video(clip.string());
  cv::Mat picture, grey;
  for (std::size_t n = 0; n < shapes.size() && video.read(picture); ++n) {
    if (n % every != 0 || eye_distance(shapes[n]) == 0) continue;
    cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
    const std::string name = clip.stem().string();
    out.push_back({name, persons.of(name), grey.clone(), shapes[n]});
  }
}

}  // namespace

std::vector<FacePicture> load_stills(const std::filesystem::path& folder,
                                     const std::filesystem::path& persons) {
  const Persons people(persons);
  std::vector<FacePicture> out;
  for (Csv csv(folder / "faces.csv"); csv.next();) {
    FacePicture face;
    face.name = csv.text("file");
    face.person = people.of(face.name);
    face.luma = cv::imread((folder / face.name).string(), cv::IMREAD_GRAYSCALE);
    if (face.luma.empty() || !csv.read(face.landmarks)) throw std::runtime_error("bad still " + face.name);
    out.push_back(std::move(face));
  }
  return out;
}

std::vector<FacePicture> load_clips(const std::filesystem::path& folder,
                                    const std::filesystem::path& reference,
                                    const std::filesystem::path& persons, int per_clip) {
  std::vector<std::filesystem::path> clips;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (std::filesystem::exists(reference / (entry.path().stem().string() + ".csv")))
      clips.push_back(entry.path());
  std::ranges::sort(clips);
  std::vector<FacePicture> out;
  const Persons people(persons);
  for (const auto& clip : clips)
    add_clip(clip, reference / (clip.stem().string() + ".csv"), people, per_clip, out);
  return out;
}

std::vector<FacePicture> load_talkers(int count) {
  std::vector<FacePicture> out;
  for (const DrawnFace& drawn : draw_talkers(count))
    out.push_back({"talker", "talker", view(drawn.luma).clone(), drawn.landmarks});
  return out;
}

}  // namespace fbs
