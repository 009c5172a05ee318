#ifndef dmgUnknownBlocks_h
#define dmgUnknownBlocks_h

#include <vector>

namespace dmg
{

/// Small sets of unknowns that are solved for together; none is empty. They may overlap.
struct UnknownBlocks
{
  std::vector<int> Offsets = { 0 }; ///< block k holds Unknowns[Offsets[k]] to [Offsets[k + 1] - 1]
  std::vector<int> Unknowns;

  int Size() const { return static_cast<int>(this->Offsets.size()) - 1; }
  void EndBlock() { this->Offsets.push_back(static_cast<int>(this->Unknowns.size())); }
};

}

#endif
