#include "fit/lobe_pass.h"

namespace gonio {

template void lobe_pass<0>(const LanePoints&, const LobeAt&, std::span<const DoubleLanes>, std::size_t, LobeColumns&);

}  // namespace gonio
