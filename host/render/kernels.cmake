# Compiles shaders/kernels/*.comp to SPIR-V, twice where they fetch geometry (from texel and from
# storage buffers), decorates, simplifies and checks them, and makes the source file that embeds
# them. Depfiles make every #include count.
find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
find_program(SPIRV_VAL spirv-val REQUIRED)

set(FACET_KERNELS bounce schedule film camera closest any)
# They see no geometry, and read one BSDF from a storage buffer, or nothing at all.
set(FACET_EVALUATION_KERNELS evaluate sample arithmetic functions)
set(FACET_KERNEL_DIR ${PROJECT_BINARY_DIR}/kernels)
file(MAKE_DIRECTORY ${FACET_KERNEL_DIR})

set(kernel_arguments)
set(kernel_inputs)
set(kernel_outputs)
macro(facet_kernel kernel fetch)
  set(name ${kernel}_${fetch})
  set(source ${PROJECT_SOURCE_DIR}/shaders/kernels/${kernel}.comp)
  set(raw ${FACET_KERNEL_DIR}/${name}.raw.spv)
  add_custom_command(
    OUTPUT ${raw}
    COMMAND ${GLSLANG_VALIDATOR} --quiet --target-env vulkan1.1 ${ARGN}
            -I${PROJECT_SOURCE_DIR}/shaders -I${PROJECT_BINARY_DIR}/generated
            --depfile ${raw}.d -o ${raw} ${source}
    DEPENDS ${source} ${FACET_PARAMETERS} ${FACET_RECORD_READS}
    DEPFILE ${raw}.d
    COMMENT "Compiling kernel ${name}"
    VERBATIM)
  list(APPEND kernel_inputs ${raw})
  list(APPEND kernel_outputs ${FACET_KERNEL_DIR}/${name}.spv)
  list(APPEND kernel_arguments ${name}=${raw}=${FACET_KERNEL_DIR}/${name}.spv)
endmacro()
foreach(kernel IN LISTS FACET_KERNELS)
  facet_kernel(${kernel} texel)
  facet_kernel(${kernel} storage -DFACET_NO_TEXEL_BUFFERS)
endforeach()
foreach(kernel IN LISTS FACET_EVALUATION_KERNELS)
  facet_kernel(${kernel} any -DFACET_NO_TEXEL_BUFFERS)
endforeach()

set(validate_commands)
foreach(output IN LISTS kernel_outputs)
  list(APPEND validate_commands COMMAND ${SPIRV_VAL} --target-env vulkan1.1 ${output})
endforeach()

set(FACET_KERNEL_SOURCE ${FACET_KERNEL_DIR}/kernels.cpp)
add_custom_command(
  OUTPUT ${FACET_KERNEL_SOURCE}
  BYPRODUCTS ${kernel_outputs}
  COMMAND embed_kernels ${FACET_KERNEL_SOURCE} ${kernel_arguments}
  ${validate_commands}
  DEPENDS embed_kernels ${kernel_inputs}
  COMMENT "Embedding the kernels"
  VERBATIM)
