# What every target of ours is compiled with. Users of the library inherit none of it.
function(meshhood_own_target target)
  # One distance predicate on every path: no fused multiply-add, whatever the compiler's default.
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror -ffp-contract=off)
endfunction()
