// Learns landmarks.table; README.md names its sources.
#include <algorithm>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <map>
#include <utility>

#include "common/ibug.h"
#include "training/belief_training.h"
#include "training/cascade_training.h"
#include "training/place_training.h"
#include "training/textures.h"

namespace fbs {
namespace {

constexpr int kFolds = 5;
constexpr int kPerClip = 10, kTalkers = 40, kTextures = 600;
constexpr int kSamplesOfAStill = 32, kSamplesOfAnother = 12;
constexpr int kPlacesOfAStill = 10, kPlacesOfAnother = 2;

/// A fold for each person, the same in every run.
std::map<std::string, int> folds_of(const std::vector<FacePicture>& faces) {
  std::vector<std::string> people(faces.size());
  std::ranges::transform(faces, people.begin(), &FacePicture::person);
  std::ranges::sort(people);
  people.erase(std::unique(people.begin(), people.end()), people.end());
  std::mt19937 random(5);
  std::ranges::shuffle(people, random);
  std::map<std::string, int> out;
  for (std::size_t i = 0; i < people.size(); ++i) out[people[i]] = static_cast<int>(i % kFolds);
  return out;
}

struct Faces {
  std::vector<FacePicture> stills, others;  ///< others: clips and talkers, many pictures of few people
  std::vector<cv::Mat1b> textures;
};

/// The textures of a fold, or all others.
std::vector<cv::Mat1b> part(const std::vector<cv::Mat1b>& textures, int fold, bool inside) {
  std::vector<cv::Mat1b> out;
  for (std::size_t i = 0; i < textures.size(); ++i)
    if ((static_cast<int>(i % kFolds) == fold) == inside) out.push_back(textures[i]);
  return out;
}

LandmarkTable train(const Faces& faces, const std::map<std::string, int>& folds, int but) {
  std::mt19937 random(static_cast<unsigned>(but + 100));
  std::vector<PatchSample> samples;
  const auto add = [&](const std::vector<FacePicture>& pictures, int count) {
    for (const FacePicture& f : pictures)
      for (int i = 0; i < count && folds.at(f.person) != but; ++i)
        samples.push_back(augmented(f, place_of(f.landmarks), {}, random));
  };
  add(faces.stills, kSamplesOfAStill);
  add(faces.others, kSamplesOfAnother);
  LandmarkTable table = train_cascade(samples);
  std::vector<FaceCount> known;
  const auto add_known = [&](const std::vector<FacePicture>& pictures, int times) {
    for (const FacePicture& f : pictures)
      if (folds.at(f.person) != but) known.push_back({f, times});
  };
  add_known(faces.stills, kPlacesOfAStill);
  add_known(faces.others, kPlacesOfAnother);
  table.places = train_places(known, part(faces.textures, but, false), table.mean, random);
  return table;
}

void report(const char* what, std::vector<float> errors) {
  std::ranges::sort(errors);
  std::cout << what << std::fixed << std::setprecision(1) << ' ' << 100 * errors[errors.size() / 2] << " / "
            << 100 * errors[errors.size() * 9 / 10] << "   ";
}

using Errors = std::map<std::string, std::vector<float>>;

void measure(const std::vector<PatchSample>& samples, const LandmarkSearch& search, Errors& errors) {
  const std::map<std::string, std::pair<int, int>> features = {
      {"jaw", {ibug::kJawFirst, ibug::kJawEnd}},
      {"brows", {ibug::kBrowsFirst, ibug::kBrowsEnd}},
      {"nose", {ibug::kNoseFirst, ibug::kNoseEnd}},
      {"eyes", {ibug::kEyesFirst, ibug::kEyesEnd}},
      {"lips", {ibug::kOuterLipsFirst, ibug::kInnerLipsFirst}},
      {"inner", {ibug::kInnerLipsFirst, ibug::kMouthEnd}}};
  for (const PatchSample& s : samples) {
    const Shape found = search.descend(s.patch).shape;
    for (const auto& [name, range] : features)
      errors[name].push_back(error_of(found, s.truth, range.first, range.second));
  }
}

void report(const Errors& errors) {
  for (const auto& [name, e] : errors) report(name.c_str(), e);
  std::cout << '\n' << std::flush;
}

void write(const LandmarkTable& table, const std::string& path) {
  const auto bytes = write_landmark_table(table);
  std::ofstream file(path, std::ios::binary);
  for (const std::uint8_t b : bytes) file.put(static_cast<char>(b));
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

int run(const std::filesystem::path& shared, const std::filesystem::path& persons, const std::string& out) {
  Faces faces{load_stills(shared / "faces", persons),
              load_clips(shared / "clips", shared / "reference", persons, kPerClip),
              draw_textures(kTextures)};
  const auto add = [&](std::vector<FacePicture> more) {
    std::ranges::move(more, std::back_inserter(faces.others));
  };
  add(load_clips(shared / "strangers", shared / "strangers/reference", persons, kPerClip));
  add(load_talkers(kTalkers));
  std::vector<FacePicture> all = faces.stills;
  all.insert(all.end(), faces.others.begin(), faces.others.end());
  const auto folds = folds_of(all);
  std::cout << faces.stills.size() << " stills and " << faces.others.size() << " others of " << folds.size()
            << " people\n";

  std::vector<LandmarkTable> tables;
  std::vector<Outcomes> outcomes;
  Errors errors;
  for (int fold = 0; fold < kFolds; ++fold) {
    tables.push_back(train(faces, folds, fold));
    const LandmarkSearch search(tables.back());
    std::vector<FacePicture> strangers;
    std::vector<PatchSample> seen;
    std::mt19937 random(static_cast<unsigned>(fold));
    for (const FacePicture& f : all)
      if (folds.at(f.person) == fold) strangers.push_back(f);
    for (const FacePicture& f : faces.stills)
      if (folds.at(f.person) == fold)
        for (int i = 0; i < 3; ++i) seen.push_back(as_it_is(f, {0.06F, 0.08F}, random));
    measure(seen, search, errors);
    report(errors);
    outcomes.push_back(try_search(search, strangers, part(faces.textures, fold, true), random));
  }
  std::ofstream names(out + ".folds");
  std::string before;
  for (const FacePicture& f : all)
    if (f.name != std::exchange(before, f.name)) names << f.name << ' ' << folds.at(f.person) << '\n';
  for (int fold = 0; fold < kFolds; ++fold) {
    std::vector<const Outcomes*> others;
    for (int k = 0; k < kFolds; ++k)
      if (k != fold) others.push_back(&outcomes[k]);
    tables[fold].belief = train_belief(others);
    write(tables[fold], out + "." + std::to_string(fold));
  }
  LandmarkTable table = train(faces, folds, -1);
  std::vector<const Outcomes*> every;
  every.reserve(outcomes.size());
  for (const Outcomes& o : outcomes) every.push_back(&o);
  table.belief = train_belief(every);
  write(table, out);
  return 0;
}

}  // namespace
}  // namespace fbs

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: train_landmarks SHARED PERSONS OUT\n"
                 "SHARED has faces/, clips/, reference/ and strangers/. Writes the table OUT, learned from\n"
                 "all; OUT.0 .. OUT.4, each learned without a fifth of the people; and OUT.folds: which\n"
                 "still or clip is in which fifth.\n";
    return 2;
  }
  try {
    return fbs::run(argv[1], argv[2], argv[3]);
  } catch (const std::exception& e) {
    std::cerr << "train_landmarks: " << e.what() << '\n';
    return 1;
  }
}
