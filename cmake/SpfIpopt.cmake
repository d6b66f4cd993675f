# spf_use_ipopt(TARGET): where Ipopt is installed the target can compare itself with it (SPF_HAVE_IPOPT). Its pkg-config
# file also names libraries for static linking, which a system need not have.
find_path(SPF_IPOPT_INCLUDE IpTNLP.hpp PATH_SUFFIXES coin coin-or)
find_library(SPF_IPOPT_LIBRARY ipopt)
if(NOT SPF_IPOPT_INCLUDE OR NOT SPF_IPOPT_LIBRARY)
  message(STATUS "Ipopt not found (coinor-libipopt-dev): the MPC is not compared with it")
endif()

function(spf_use_ipopt TARGET)
  if(SPF_IPOPT_INCLUDE AND SPF_IPOPT_LIBRARY)
    target_include_directories(${TARGET} SYSTEM PRIVATE ${SPF_IPOPT_INCLUDE})
    target_link_libraries(${TARGET} PRIVATE ${SPF_IPOPT_LIBRARY})
    target_compile_definitions(${TARGET} PRIVATE SPF_HAVE_IPOPT HAVE_CSTDDEF)
  endif()
endfunction()
