// SPDX-License-Identifier: MIT
#include "support/disk_model.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "support/random.h"

namespace meshhood::test {

/// All possible contents of a file.
class DiskModel::Survivors {
 public:
  Survivors(const File& file, const std::function<void(const std::string*)>& f) : file_(file), f_(f) {
    for (const Write& write : file.writes) full_size_ = std::max(full_size_, write.end());
    full_size_ = std::max(full_size_, file.synced.size());
    pages_ = (full_size_ + kPage - 1) / kPage;
  }

  void visit() const {
    record(0, file_.synced.size());
    if (file_.writes.empty()) return;
    cut_off();
    tear();
    tear_at_random();
  }

 private:
  using PageSet = std::function<bool(std::size_t page)>;

  /// The first `count` writes, the last of them only by half.
  void cut_off() const {
    std::size_t size = file_.synced.size();
    for (std::size_t count = 1; count <= file_.writes.size(); ++count) {
      const Write& last = file_.writes[count - 1];
      const std::size_t middle = (last.position + last.end()) / 2;
      record(count, std::max(size, middle));
      size = std::max(size, last.end());
      record(count, size);
      record(count - 1, full_size_);
      record(count, full_size_, [&](std::size_t page) { return page < middle / kPage; });
    }
  }

  void tear() const {
    const std::size_t all = file_.writes.size();
    for (std::size_t torn = 0; torn < pages_; ++torn) {
      record(all, full_size_, [&](std::size_t page) { return page != torn; });
      record(all, full_size_, [&](std::size_t page) { return page == torn; });
    }
  }

  void tear_at_random() const {
    constexpr std::size_t kDraws = 100;
    Random random(pages_);
    for (std::size_t i = 0; i < kDraws; ++i) {
      const std::size_t count = 1 + random.below(file_.writes.size());
      std::vector<bool> kept(pages_);
      for (std::size_t page = 0; page < pages_; ++page) kept[page] = random.below(2) == 0;
      record(count, full_size_, [&](std::size_t page) { return kept[page]; });
    }
  }

  /// The first `count` writes, restricted to the given pages, in a file of the given size.
  void record(std::size_t count, std::size_t size, const PageSet& has_come = {}) const {
    std::string content = file_.synced;
    content.resize(full_size_, '\0');
    for (std::size_t i = 0; i < count; ++i) write(file_.writes[i], content, has_come);
    content.resize(size);
    f_(&content);
  }

  static void write(const Write& write, std::string& content, const PageSet& has_come) {
    for (std::size_t begin = write.position; begin < write.end();) {
      const std::size_t end = std::min((begin / kPage + 1) * kPage, write.end());
      if (!has_come || has_come(begin / kPage)) {
        content.replace(begin, end - begin, write.bytes, begin - write.position, end - begin);
      }
      begin = end;
    }
  }

  const File& file_;
  const std::function<void(const std::string*)>& f_;
  std::size_t full_size_ = 0;
  std::size_t pages_ = 0;
};

void DiskModel::put(const std::string& path, std::string content) {
  files_.push_back({std::move(content)});
  names_[path] = {files_.size() - 1};
}

std::optional<DiskModel::FileId> DiskModel::find(const std::string& path) const {
  const auto name = names_.find(path);
  return name == names_.end() ? std::nullopt : name->second.back();
}

void DiskModel::let_stand_for(const std::string& path, std::optional<FileId> file) {
  auto& past = names_.try_emplace(path, 1, std::nullopt).first->second;
  past.push_back(file);
}

void DiskModel::apply(const Effect& effect) {
  switch (effect.call) {
    case Call::Open: open(effect); break;
    case Call::Write: write(effect); break;
    case Call::Seek: open_.at(effect.file).position = effect.position; break;
    case Call::Sync: sync(open_.at(effect.file)); break;
    case Call::Close: open_.erase(effect.file); break;
    case Call::Rename:
      let_stand_for(effect.to, find(effect.path));
      let_stand_for(effect.path, std::nullopt);
      break;
    case Call::Unlink: let_stand_for(effect.path, std::nullopt); break;
    case Call::Look:
    case Call::ChangeOwner:
    case Call::ChangeMode: break;
  }
}

void DiskModel::open(const Effect& effect) {
  const bool is_folder = std::filesystem::is_directory(effect.path);
  if (!is_folder && !find(effect.path)) {
    files_.push_back({});
    let_stand_for(effect.path, files_.size() - 1);
  }
  open_[effect.file] = {effect.path, is_folder ? std::nullopt : find(effect.path)};
}

void DiskModel::write(const Effect& effect) {
  Open& open = open_.at(effect.file);
  if (!open.file) throw std::logic_error("a folder was written to");
  files_[*open.file].writes.push_back({open.position, effect.bytes});
  open.position += effect.bytes.size();
}

void DiskModel::sync(const Open& open) {
  if (open.file) {
    File& file = files_[*open.file];
    for (const Write& write : file.writes) {
      file.synced.resize(std::max(file.synced.size(), write.end()), '\0');
      file.synced.replace(write.position, write.bytes.size(), write.bytes);
    }
    file.writes.clear();
    return;
  }
  for (auto& [path, past] : names_) {
    if (std::filesystem::path(path).parent_path() == open.path) past.erase(past.begin(), past.end() - 1);
  }
}

void DiskModel::for_each_survivor(const std::string& path, const std::function<void(const std::string*)>& f) const {
  const auto name = names_.find(path);
  if (name == names_.end()) {
    f(nullptr);
    return;
  }
  for (const std::optional<FileId>& file : name->second) {
    if (file) {
      Survivors(files_[*file], f).visit();
    } else {
      f(nullptr);
    }
  }
}

}  // namespace meshhood::test
