#include "Adapters/Surface/PreparedDataSet.h"

#include <map>
#include <mutex>
#include <tuple>
#include <utility>

namespace dmg
{

namespace
{

/// The surfaces that somebody holds.
class HeldSurfaces
{
public:
  using Key = std::tuple<std::string, Numbering, bool>; ///< the digest says all but the order and the sides

  std::shared_ptr<const PreparedDataSet> Find(const Key& key)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    const auto found = this->Surfaces.find(key);
    return found == this->Surfaces.end() ? nullptr : found->second.lock();
  }

  void Add(const Key& key, const std::shared_ptr<const PreparedDataSet>& surface)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    for (auto held = this->Surfaces.begin(); held != this->Surfaces.end();)
    {
      held = held->second.expired() ? this->Surfaces.erase(held) : std::next(held);
    }
    this->Surfaces[key] = surface;
  }

private:
  std::mutex Mutex;
  std::map<Key, std::weak_ptr<const PreparedDataSet>> Surfaces;
};

HeldSurfaces& Held()
{
  static HeldSurfaces held;
  return held;
}

}

std::shared_ptr<const PreparedDataSet> PrepareDataSet(
  vtkDataSet* surface, const PreparationOptions& options, const ExecutionContext& context)
{
  return PrepareDataSet(surface, ContentDigest(surface, options), options, context);
}

std::shared_ptr<const PreparedDataSet> PrepareDataSet(
  vtkDataSet* surface, const std::string& digest, const PreparationOptions& options, const ExecutionContext& context)
{
  const HeldSurfaces::Key key(digest, options.Order, options.KeepsSides);
  if (auto held = Held().Find(key))
  {
    return held;
  }
  SurfaceMesh mesh = MeshFromDataSet(surface, options, context);
  auto prepared = std::make_shared<const PreparedDataSet>(PreparedDataSet{
    FramedMesh(std::move(mesh.Mesh), context), std::move(static_cast<SurfaceRelation&>(mesh)), mesh.Report, digest });
  Held().Add(key, prepared);
  return prepared;
}

}
