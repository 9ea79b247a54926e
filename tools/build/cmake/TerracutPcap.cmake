# pcap::pcap, for the build and for consumers alike: libpcap ships no CMake package of its own.
if(NOT TARGET pcap::pcap)
  find_path(PCAP_INCLUDE_DIR pcap/pcap.h)
  find_library(PCAP_LIBRARY pcap)
  mark_as_advanced(PCAP_INCLUDE_DIR PCAP_LIBRARY)
  if(PCAP_INCLUDE_DIR AND PCAP_LIBRARY)
    set(PCAP_FOUND ON)
    add_library(pcap::pcap UNKNOWN IMPORTED)
    set_target_properties(pcap::pcap PROPERTIES
      IMPORTED_LOCATION "${PCAP_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${PCAP_INCLUDE_DIR}")
  endif()
endif()
