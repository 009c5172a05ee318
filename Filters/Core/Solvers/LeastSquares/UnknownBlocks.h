#ifndef dmgUnknownBlocks_h
#define dmgUnknownBlocks_h

#include <vector>

namespace dmg
{

/// Small sets of unknowns that are solved for together; none is empty. They may overlap.
struct UnknownBlocks
{
  static constexpr int LargestBlock = 64;

  std::vector<int> Offsets = { 0 }; ///< block k holds Unknowns[Offsets[k]] to [Offsets[k + 1] - 1]
  std::vector<int> Unknowns;

  int Size() const { return static_cast<int>(this->Offsets.size()) - 1; }
  int SizeOf(int block) const { return this->Offsets[block + 1] - this->Offsets[block]; }
  void EndBlock() { this->Offsets.push_back(static_cast<int>(this->Unknowns.size())); }

  /// These blocks in another order.
  UnknownBlocks InOrder(const std::vector<int>& order) const
  {
    UnknownBlocks ordered;
    ordered.Offsets.reserve(order.size() + 1);
    ordered.Unknowns.reserve(this->Unknowns.size());
    for (const int k : order)
    {
      const auto begin = this->Unknowns.begin() + this->Offsets[k];
      ordered.Unknowns.insert(ordered.Unknowns.end(), begin, begin + this->SizeOf(k));
      ordered.EndBlock();
    }
    return ordered;
  }
};

}

#endif
